//! Which segments say enough to be looked for in another map.

use crate::Signature;
use ogm_core::{ParameterError, require};

/// When a segment is worth comparing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistinctiveParams {
    /// Bins of the distance histogram; the paper prints none.
    pub distance_bins: usize,
    /// Bins of the arc histogram.
    pub arc_bins: usize,
    /// By how many points the fullest distance bin must exceed the emptiest (Eq. 10): a straight
    /// wall fills all alike, give or take a point. Low, because
    /// hypotheses are cheap.
    pub min_range: usize,
    /// Longest arc, as a multiple of the length of the segment (Eq. 11): a longer one is a gap.
    pub max_arc: f64,
}

impl Default for DistinctiveParams {
    fn default() -> Self {
        Self { distance_bins: 10, arc_bins: 10, min_range: 2, max_arc: 3.0 }
    }
}

impl DistinctiveParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let bins = self.distance_bins.min(self.arc_bins);
        let most = self.distance_bins.max(self.arc_bins);
        let requirement = "between 2 and 1000 bins";
        require(bins >= 2, "distinctive.distance_bins, arc_bins", requirement, bins as f64)?;
        require(most <= 1000, "distinctive.distance_bins, arc_bins", requirement, most as f64)?;
        require(self.max_arc > 0.0, "distinctive.max_arc", "above 0", self.max_arc)
    }
}

/// Share of a bin by which rounding may carry a value over its end.
const ROUNDING: f64 = 1e-9;

/// Counts over equal bins.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Histogram {
    /// Lower end of the first bin.
    pub from: f64,
    /// Upper end of the last bin.
    pub to: f64,
    /// How many values each bin holds.
    pub counts: Vec<u32>,
}

impl Histogram {
    /// Counts `values` in `bins` bins over [`from`, `to`]; what lies outside goes to the end bins.
    ///
    /// A bin holds its upper end and not its lower one: distances are positive and the greatest
    /// is the end of the range, so a straight wall fills all bins alike.
    #[must_use]
    pub(crate) fn new(values: &[f64], from: f64, to: f64, bins: usize) -> Self {
        let mut counts = vec![0; bins];
        let scale = if to > from { bins as f64 / (to - from) } else { 0.0 };
        for value in values {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturates, and the end bins take what lies outside"
            )]
            let bin = ((value - from) * scale - ROUNDING).ceil() as usize;
            if let Some(count) = counts.get_mut(bin.clamp(1, bins.max(1)) - 1) {
                *count += 1;
            }
        }
        Self { from, to, counts }
    }
}

/// The distance histogram over [0, max d] and the arc histogram over [min ω, max ω] of a segment
/// (Saeedi et al., Eqs. 8 and 9).
#[must_use]
pub(crate) fn histograms(signature: &Signature, params: &DistinctiveParams) -> [Histogram; 2] {
    let (_, far) = range(&signature.distance);
    let (low, high) = range(&signature.arc);
    [
        Histogram::new(&signature.distance, 0.0, far, params.distance_bins),
        Histogram::new(&signature.arc, low, high, params.arc_bins),
    ]
}

/// Whether a segment of `length` metres is worth comparing: no empty distance bin, distances that
/// do not fill all bins alike, and no gap (Saeedi et al., section II.E).
#[must_use]
pub fn is_distinctive(signature: &Signature, length: f64, params: &DistinctiveParams) -> bool {
    let [distance, _] = histograms(signature, params);
    let fewest = distance.counts.iter().copied().min().unwrap_or(0);
    let most = distance.counts.iter().copied().max().unwrap_or(0);
    let longest = signature.arc.iter().fold(0.0, |longest: f64, arc| longest.max(arc.abs()));
    fewest > 0 && (most - fewest) as usize >= params.min_range && longest <= params.max_arc * length
}

/// Least and greatest value.
pub(crate) fn range(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::{DistinctiveParams, is_distinctive};
    use crate::signature;
    use nalgebra::Point2;

    fn accepted(at: impl Fn(f64) -> (f64, f64)) -> bool {
        let points: Vec<_> =
            (0..=60).map(|i| at(f64::from(i) * 0.05)).map(|(x, y)| Point2::new(x, y)).collect();
        is_distinctive(&signature(&points).unwrap(), 3.0, &DistinctiveParams::default())
    }

    #[test]
    fn a_straight_wall_is_like_any_other_and_a_bent_one_is_not() {
        assert!(!accepted(|s| (s, 0.2 * s)));
        assert!(accepted(|s| (s.min(1.8), (s - 1.8).max(0.0))));
    }

    #[test]
    fn a_gap_makes_a_segment_useless() {
        assert!(!accepted(|s| (s.min(1.8), (s - 1.8).max(0.0) + if s > 2.0 { 20.0 } else { 0.0 })));
    }
}
