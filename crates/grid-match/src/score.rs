//! What the evidence for a pose is worth.

use crate::evidence::Evidence;
use crate::terms::TERMS;
use crate::weights::WEIGHTS;

/// Most metres of wall that make a pose surer, and of compared wall whose conflicts are taken in
/// full; of more, the share that would be as much: larger maps are bent more.
const FULL_WALL_M: f64 = 150.0;
/// More free area, and more wall across both directions, makes no pose surer.
const MOST_FREE_M2: f64 = 150.0;
const MOST_CROSS_M: f64 = 40.0;

/// Less overlap makes no pose less likely.
const LEAST_OVERLAP: f64 = 0.02;
/// Chance hits rarer than this make no pose surer.
const LEAST_CHANCE: f64 = 0.02;

impl Evidence {
    /// What the score is made of: each term grows with what speaks for the pose and never with
    /// what speaks against it ([`TERM_NAMES`](crate::TERM_NAMES)).
    #[must_use]
    pub fn terms(&self) -> [f64; TERMS] {
        let relaxed = &self.relaxed;
        let against = relaxed.near_miss_m + relaxed.conflict_m;
        let fit = ((relaxed.hit_m + 0.5) / (against + 1.0)).ln();
        let share = share_of(relaxed.hit_m + against);
        let rigid_share = share_of(self.hit_m + self.near_miss_m + self.conflict_m);
        [
            fit,
            relaxed.hit_m.min(FULL_WALL_M).ln_1p(),
            self.free_m2.min(MOST_FREE_M2).ln_1p(),
            self.overlap.max(LEAST_OVERLAP).ln(),
            -(share * relaxed.conflict_m).ln_1p(),
            -(rigid_share * self.near_miss_m).ln_1p(),
            self.cross_m.min(MOST_CROSS_M).ln_1p(),
            -self.chance.max(LEAST_CHANCE).ln(),
        ]
    }

    /// Log-odds that the pose is right against that no pose is; −12 for what cannot be compared.
    #[must_use]
    pub fn score(&self) -> f64 {
        if !self.is_comparable() {
            return NOT_COMPARABLE;
        }
        let terms = self.terms();
        let weighted = WEIGHTS.terms.iter().zip(terms).map(|(weight, term)| weight * term);
        (WEIGHTS.bias + weighted.sum::<f64>()).max(NOT_COMPARABLE)
    }
}

/// Score of a pose about which the maps say nothing.
pub(crate) const NOT_COMPARABLE: f64 = -12.0;

fn share_of(compared_m: f64) -> f64 {
    (FULL_WALL_M / compared_m.max(1e-9)).min(1.0)
}

#[cfg(test)]
mod tests {
    use crate::evidence::{Evidence, Relaxed};
    use crate::terms::Weights;
    use crate::weights::WEIGHTS;
    use proptest::prelude::{Strategy, prop_assert, proptest};

    fn evidence() -> impl Strategy<Value = Evidence> {
        let walls = || (0.0_f64..300.0, 0.0_f64..80.0, 0.0_f64..80.0);
        let rest = (0.5_f64..400.0, 0.0_f64..1.0, 0.0_f64..1.0, 0.0_f64..0.6);
        (walls(), walls(), rest, 0.0_f64..1.0).prop_map(
            |(
                (hit_m, near_miss_m, conflict_m),
                relaxed,
                (free_m2, overlap, cross, chance),
                same,
            )| {
                let same_side_m = hit_m * (0.3 + 0.7 * same);
                Evidence {
                    hit_m,
                    near_miss_m,
                    conflict_m,
                    free_m2,
                    overlap,
                    same_side_m,
                    opposite_side_m: 0.3 * (hit_m - same_side_m),
                    cross_m: 0.5 * cross * same_side_m,
                    chance,
                    relaxed: Relaxed {
                        hit_m: relaxed.0,
                        near_miss_m: relaxed.1,
                        conflict_m: relaxed.2,
                        moved_m: 0.1,
                    },
                }
            },
        )
    }

    proptest! {
        #[test]
        fn more_wall_that_fits_never_lowers_the_score_and_more_conflict_never_raises_it(
            before in evidence(), more in 0.0_f64..30.0,
        ) {
            let hits = |e: &mut Evidence| {
                e.hit_m += more;
                e.same_side_m += more;
                e.relaxed.hit_m += more;
            };
            let conflicts = |e: &mut Evidence| {
                e.conflict_m += more;
                e.relaxed.conflict_m += more;
            };
            let misses = |e: &mut Evidence| {
                e.near_miss_m += more;
                e.relaxed.near_miss_m += more;
            };
            let score = before.score();
            let after = |change: &dyn Fn(&mut Evidence)| {
                let mut changed = before;
                change(&mut changed);
                changed.score()
            };
            prop_assert!(after(&hits) >= score - 1e-9);
            prop_assert!(after(&conflicts) <= score + 1e-9);
            prop_assert!(after(&misses) <= score + 1e-9);
            prop_assert!(after(&|e| e.free_m2 += more) >= score - 1e-9);
            prop_assert!(after(&|e| e.cross_m += more) >= score - 1e-9);
        }
    }

    #[test]
    fn no_weight_is_below_zero() {
        let Weights { score, lead, rival, repeats, repeats_odds, .. } = WEIGHTS;
        let parts = [score, lead, rival, repeats, repeats_odds];
        assert!(repeats_odds <= 1.0);
        assert!(WEIGHTS.terms.iter().chain(&parts).all(|&weight| weight >= 0.0));
    }
}
