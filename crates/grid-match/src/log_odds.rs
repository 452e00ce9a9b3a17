//! How much the evidence says that a pose is right.

use crate::evidence::Evidence;

/// Log-odds of a pose about which the maps say nothing.
pub(crate) const NOT_COMPARABLE: f64 = -12.0;

/// Most metres of compared wall of a pair whose counts are taken in full; of more, the share that
/// would be as much. Larger maps than those of the fit are not surer without end.
const FULL_WALL_M: f64 = 150.0;

impl Evidence {
    /// Log-odds that the pose is right against that no pose is; −12 for what cannot be compared.
    #[must_use]
    pub fn score(&self) -> f64 {
        if self.is_comparable() { log_odds(self) } else { NOT_COMPARABLE }
    }
}

/// Log-odds of a pose against none being right.
///
/// A conditional logit over the poses that were found for simulated pairs of maps, fitted to which
/// of them is right, if any, with the terms that raised the likelihood of pairs left out most.
fn log_odds(evidence: &Evidence) -> f64 {
    let Evidence { hit_m, near_miss_m, conflict_m, overlap, .. } = *evidence;
    let relaxed = &evidence.relaxed;
    let share = share_of(hit_m + near_miss_m + conflict_m);
    let relaxed_share = share_of(relaxed.hit_m + relaxed.near_miss_m + relaxed.conflict_m);
    let sided = evidence.same_side_m + evidence.opposite_side_m;

    let fit = fit(hit_m, near_miss_m + conflict_m);
    let relaxed_fit = self::fit(relaxed.hit_m, relaxed.near_miss_m + relaxed.conflict_m);
    let free = (share * evidence.free_m2).ln_1p();
    let same = (share * evidence.same_side_m).ln_1p();
    let cross = (share * evidence.cross_m).ln_1p();
    let near = (share * near_miss_m).ln_1p();
    let conflict = (relaxed_share * relaxed.conflict_m).ln_1p();
    let opposite = evidence.opposite_side_m / sided.max(1e-9);
    let moved = relaxed.moved_m;
    let terms = [
        (-8.922, 1.0),
        (-0.056, relaxed_fit),
        (1.397, fit),
        (1.736, free),
        (0.817, overlap),
        (-2.504, same),
        (1.830, opposite),
        (6.690, moved),
        (-1.494, conflict),
        (0.088, cross),
        (9.893, fit * moved),
        (0.360, free * free),
        (2.884, relaxed_fit * overlap),
        (-29.858, overlap * moved),
        (0.164, same * cross),
        (-3.137, opposite * near),
        (0.211, free * near),
    ];
    terms.iter().map(|(weight, term)| weight * term).sum()
}

/// [`log_odds`] without the relaxed walls: what deserves a closer look.
pub(crate) fn rough_log_odds(evidence: &Evidence) -> f64 {
    if !evidence.is_comparable() {
        return NOT_COMPARABLE;
    }
    let Evidence { hit_m, near_miss_m, conflict_m, free_m2, .. } = *evidence;
    let share = share_of(hit_m + near_miss_m + conflict_m);
    1.52 * fit(hit_m, near_miss_m + conflict_m) + 4.68 * (share * free_m2).ln_1p()
        - 3.34 * (share * conflict_m).ln_1p()
        - 13.03
}

/// Logarithm of the wall that fits over the wall that does not, both with a little of each.
fn fit(hit_m: f64, against_m: f64) -> f64 {
    ((hit_m + 0.5) / (against_m + 1.0)).ln()
}

fn share_of(compared_m: f64) -> f64 {
    (FULL_WALL_M / compared_m.max(1e-9)).min(1.0)
}
