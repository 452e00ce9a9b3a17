//! What the evidence for a pose is worth.

use crate::evidence::Evidence;
use crate::terms::TERMS;
use crate::weights::WEIGHTS;

/// Most metres of compared wall whose conflicts are taken in full; of more, the share that would be
/// as much: larger maps are bent more.
const FULL_WALL_M: f64 = 150.0;
/// Metres of wall that are taken to miss where none does.
const LEAST_AGAINST_M: f64 = 2.0;
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
        let against = relaxed.walls.map(|walls| of_full(walls.against_m(), walls.hit_m));
        let conflict = relaxed.walls.map(|walls| of_full(walls.conflict_m, walls.hit_m));
        [
            relaxed.corners.sqrt(),
            -(against[0].min(against[1]) + LEAST_AGAINST_M).ln(),
            -conflict[0].max(conflict[1]).ln_1p(),
            -of_full(self.near_miss_m, self.hit_m).ln_1p(),
            self.overlap.max(LEAST_OVERLAP).ln(),
            -self.chance.max(LEAST_CHANCE).ln(),
        ]
    }

    /// Log-odds that the pose is right against that no pose is; −12 for what cannot be compared.
    #[must_use]
    pub fn score(&self) -> f64 {
        if self.is_comparable() { self.weighted() } else { NOT_COMPARABLE }
    }

    /// The score of a pose that is not yet refined to the thickness of a wall.
    pub(crate) fn rough_score(&self) -> f64 {
        if self.is_promising() { self.weighted() } else { NOT_COMPARABLE }
    }

    fn weighted(&self) -> f64 {
        let terms = self.terms();
        let weighted = WEIGHTS.terms.iter().zip(terms).map(|(weight, term)| weight * term);
        (WEIGHTS.bias + weighted.sum::<f64>()).max(NOT_COMPARABLE)
    }
}

/// Score of a pose about which the maps say nothing.
pub(crate) const NOT_COMPARABLE: f64 = -12.0;

/// Metres of wall that speak against a pose beside `hit_m` that fit; of more than the full wall,
/// the share that would be as much.
fn of_full(against_m: f64, hit_m: f64) -> f64 {
    against_m * (FULL_WALL_M / (hit_m + against_m).max(1e-9)).min(1.0)
}

#[cfg(test)]
mod tests {
    use crate::evidence::{Evidence, Relaxed, WallFit};
    use crate::terms::Weights;
    use crate::weights::WEIGHTS;
    use proptest::prelude::{Strategy, prop_assert, proptest};

    fn evidence() -> impl Strategy<Value = Evidence> {
        let walls = || (0.0_f64..300.0, 0.0_f64..80.0, 0.0_f64..80.0);
        let walls = || {
            walls().prop_map(|(hit_m, near_miss_m, conflict_m)| WallFit {
                hit_m,
                near_miss_m,
                conflict_m,
            })
        };
        let rest = (0.5_f64..400.0, 0.0_f64..1.0, 0.0_f64..80.0, 0.0_f64..0.6);
        (walls(), [walls(), walls()], rest, 0.0_f64..1.0).prop_map(
            |(rigid, walls, (free_m2, overlap, corners, chance), same)| {
                let same_side_m = rigid.hit_m * (0.3 + 0.7 * same);
                Evidence {
                    hit_m: rigid.hit_m,
                    near_miss_m: rigid.near_miss_m,
                    conflict_m: rigid.conflict_m,
                    free_m2,
                    overlap,
                    same_side_m,
                    opposite_side_m: 0.3 * (rigid.hit_m - same_side_m),
                    chance,
                    relaxed: Relaxed { walls, corners, moved_m: 0.1 },
                }
            },
        )
    }

    proptest! {
        #[test]
        fn more_wall_that_fits_never_lowers_the_score_and_more_conflict_never_raises_it(
            before in evidence(), more in 0.0_f64..30.0, of in 0_usize..2,
        ) {
            let score = before.score();
            let after = |change: &dyn Fn(&mut Evidence)| {
                let mut changed = before;
                change(&mut changed);
                changed.score()
            };
            let hits = after(&|e| {
                e.hit_m += more;
                e.same_side_m += more;
                e.relaxed.walls[of].hit_m += more;
            });
            let conflicts = after(&|e| {
                e.conflict_m += more;
                e.relaxed.walls[of].conflict_m += more;
            });
            let misses = after(&|e| {
                e.near_miss_m += more;
                e.relaxed.walls[of].near_miss_m += more;
            });
            prop_assert!(hits >= score - 1e-9);
            prop_assert!(conflicts <= score + 1e-9);
            prop_assert!(misses <= score + 1e-9);
            prop_assert!(after(&|e| e.relaxed.corners += more) >= score - 1e-9);
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
