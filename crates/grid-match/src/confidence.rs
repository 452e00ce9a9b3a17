//! From scored poses to distinct modes and what to believe of them.

use nalgebra::Point2;

use crate::search::Fit;
use crate::translation::same_place;

/// Poses further apart than this at the centre of the second map are different answers, metres.
const MODE_M: f64 = 0.75;
/// Poses turned further apart than this are different answers, radians.
const MODE_RAD: f64 = 0.1;
/// Score of no pose at all.
pub(crate) const FLOOR: f64 = 0.0;

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

/// Probability that the mode at `index` is the right one of all modes and of no pose at all.
pub(crate) fn probability(modes: &[Fit], index: usize) -> f64 {
    let highest = modes.iter().map(|mode| mode.score).fold(FLOOR, f64::max);
    let weight = |score: f64| (score - highest).exp();
    let total: f64 = modes.iter().map(|mode| weight(mode.score)).sum();
    weight(modes[index].score) / (total + weight(FLOOR))
}
