//! From scored poses to distinct modes and what to believe of them.

use nalgebra::Point2;

use crate::search::Fit;
use crate::translation::same_place;

/// Poses further apart than this at the centre of the second map are different answers, metres.
const MODE_M: f64 = 0.75;
/// Poses turned further apart than this are different answers, radians.
const MODE_RAD: f64 = 0.1;
/// Score of a pose that explains as much as no pose does.
pub(crate) const FLOOR: f64 = -4.0;
/// Lead beyond which more says nothing.
const MOST_LEAD: f64 = 6.0;
/// Logistic regression of being right on the lead, fitted on simulated pairs.
const SLOPE: f64 = 1.18;
/// See [`SLOPE`].
const OFFSET: f64 = -0.79;

/// The best fit of every mode, best first.
pub(crate) fn modes(mut fits: Vec<Fit>, centre: Point2<f64>) -> Vec<Fit> {
    fits.sort_by(|a, b| {
        b.score.total_cmp(&a.score).then(b.evidence.hit_m.total_cmp(&a.evidence.hit_m))
    });
    let mut modes: Vec<Fit> = Vec::new();
    for fit in fits {
        let pose = &fit.first_from_second;
        if modes
            .iter()
            .all(|mode| !same_place(&mode.first_from_second, pose, centre, MODE_M, MODE_RAD))
        {
            modes.push(fit);
        }
    }
    modes
}

/// Probability that the mode at `index` is right: a logistic function of its lead over the best of
/// the others, or over no pose at all.
pub(crate) fn probability(modes: &[Fit], index: usize) -> f64 {
    let others = modes.iter().enumerate().filter(|&(other, _)| other != index);
    let rival = others.map(|(_, mode)| mode.score).fold(FLOOR, f64::max);
    let lead = (modes[index].score - rival).min(MOST_LEAD);
    1.0 / (1.0 + (-(SLOPE * lead + OFFSET)).exp())
}
