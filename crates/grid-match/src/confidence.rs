//! From scored poses to distinct modes and what to believe of them.

use nalgebra::Point2;

use crate::log_odds::NOT_COMPARABLE;
use crate::search::Fit;
use crate::translation::same_place;

/// Poses further apart than this at the centre of the second map are different answers, metres.
const MODE_M: f64 = 0.75;
/// Poses turned further apart than this are different answers, radians.
const MODE_RAD: f64 = 0.1;
/// Score of no pose at all.
pub(crate) const FLOOR: f64 = 0.0;
/// A larger lead over the second mode says no more.
const MOST_LEAD: f64 = 6.0;
/// Taken off the log-odds of a pose that has support, for a wrong merge costs more than a refusal.
const CAUTION: f64 = 0.3;
/// A larger score says no more.
const MOST_SCORE: f64 = 8.0;

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

/// Probability that the first of `modes` is right.
///
/// A logistic regression on simulated pairs, a little lowered: the lead over the second mode, the
/// score itself, and against it the score of the second mode, for where one wrong pose fits well
/// the building repeats itself, and the right pose may be one more that the maps do not show.
pub(crate) fn best_probability(modes: &[Fit]) -> f64 {
    let score = |index: usize| modes.get(index).map_or(NOT_COMPARABLE, |mode| mode.score);
    let (best, second) = (score(0), score(1));
    let lead = (best - second).min(MOST_LEAD);
    let (doubt, support) = (best.min(FLOOR), best.clamp(FLOOR, MOST_SCORE));
    let rival = second.max(FLOOR).ln_1p();
    let caution = CAUTION * support.min(1.0);
    let log_odds =
        -1.459 + 0.601 * lead + 0.902 * doubt + 0.395 * support - 1.409 * rival - caution;
    1.0 / (1.0 + (-log_odds).exp())
}

/// Probability that the mode at `index` is the right one of all modes and of no pose at all; what
/// the first leaves is shared by the others as their scores say.
pub(crate) fn probability(modes: &[Fit], index: usize) -> f64 {
    let best = best_probability(modes);
    if index == 0 {
        return best;
    }
    let others = &modes[1..];
    let highest = others.iter().map(|mode| mode.score).fold(FLOOR, f64::max);
    let weight = |score: f64| (score - highest).exp();
    let total: f64 = others.iter().map(|mode| weight(mode.score)).sum();
    let share = (1.0 - best) * weight(modes[index].score) / (total + weight(FLOOR));
    // Where several fit alike, what all of them lack is left to poses that were not found.
    share.min(best)
}
