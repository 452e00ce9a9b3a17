//! How alike two segments are.

use crate::distinctive::{Histogram, range};
use crate::{DistinctiveParams, Signature};

/// Zero-lag correlations of two segments, each the cosine between two vectors: 1 is alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correlation {
    /// Of the distance histograms over one range.
    pub distance_histogram: f64,
    /// Of the arc histograms over one range.
    pub arc_histogram: f64,
    /// Of the distance vectors.
    pub distance: f64,
    /// Of the arc vectors.
    pub arc: f64,
}

impl Correlation {
    /// The least of the four: all must be high.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.distance_histogram.min(self.arc_histogram).min(self.distance).min(self.arc)
    }
}

/// Correlates histograms and vectors of two segments of equally many points (Saeedi et al.,
/// section II.F, where the correlation of the one-dimensional histograms is called 2D).
///
/// Histograms are built anew over the range of both, or equal shapes of different size would look
/// alike. What has no direction, such as a segment without arcs, correlates with nothing: 0.
#[must_use]
pub fn correlate(a: &Signature, b: &Signature, params: &DistinctiveParams) -> Correlation {
    let [distance_histogram, arc_histogram] = histogram_correlations(a, b, params);
    Correlation {
        distance_histogram,
        arc_histogram,
        distance: cosine(&a.distance, &b.distance),
        arc: cosine(&a.arc, &b.arc),
    }
}

pub(crate) fn histogram_correlations(
    a: &Signature,
    b: &Signature,
    params: &DistinctiveParams,
) -> [f64; 2] {
    let of = |a: &[f64], b: &[f64], from: f64, to: f64, bins| {
        let [a, b] = [a, b].map(|values| {
            let histogram = Histogram::new(values, from, to, bins);
            histogram.counts.into_iter().map(f64::from).collect::<Vec<_>>()
        });
        cosine(&a, &b)
    };
    let far = range(&a.distance).1.max(range(&b.distance).1);
    let (low, high) = range(&a.arc);
    let (other_low, other_high) = range(&b.arc);
    [
        of(&a.distance, &b.distance, 0.0, far, params.distance_bins),
        of(&a.arc, &b.arc, low.min(other_low), high.max(other_high), params.arc_bins),
    ]
}

fn cosine(a: &[f64], b: &[f64]) -> f64 {
    let norms = (dot(a, a) * dot(b, b)).sqrt();
    if norms > 0.0 { dot(a, b) / norms } else { 0.0 }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::correlate;
    use crate::{DistinctiveParams, Signature, signature};
    use nalgebra::Point2;

    fn corner(first: f64, side: f64) -> Signature {
        let points: Vec<_> = (0..=60)
            .map(|i| f64::from(i) * 0.05)
            .map(|s| Point2::new(s.min(first), side * (s - first).max(0.0)))
            .collect();
        signature(&points).unwrap()
    }

    #[test]
    fn a_segment_is_like_itself_and_unlike_its_mirror_image_and_other_corners() {
        let params = DistinctiveParams::default();
        let same = correlate(&corner(1.2, 1.0), &corner(1.2, 1.0), &params);
        assert!((same.least() - 1.0).abs() < 1e-12, "{same:?}");
        let mirrored = correlate(&corner(1.2, 1.0), &corner(1.2, -1.0), &params);
        assert!(mirrored.arc < -0.99 && mirrored.distance > 0.99, "{mirrored:?}");
        let other = correlate(&corner(1.2, 1.0), &corner(2.4, 1.0), &params);
        assert!(other.least() < 0.8, "{other:?}");
    }
}
