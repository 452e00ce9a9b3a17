//! What the walls of one map meet in another.

use nalgebra::Matrix2;
use ogm_core::Se2;

use crate::evidence::WallFit;
use crate::lattice::Slope;
use crate::prepare::PreparedMap;
use crate::sides::Facing;
use crate::state::State;
use crate::wall_points::WallPoint;

/// Distances that divide a hit from a near miss and that from a conflict, metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    pub(crate) hit: f64,
    pub(crate) near: f64,
}

impl Reach {
    /// For maps of at most `resolution` metres a cell.
    pub(crate) fn at(resolution: f64) -> Self {
        let hit = (1.5 * resolution).max(0.12);
        Self { hit, near: (2.0 * hit).max(0.35) }
    }
}

/// A metre of wall in free space takes off so many that fit, within a patch.
const AGAINST: f64 = 2.0;
/// Metres of hits beyond that by which a patch fits by half.
const HALF_FITS_M: f64 = 0.2;

/// Metres of wall of one map by what the other says there.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WallCounts {
    pub(crate) hit: f64,
    pub(crate) near_miss: f64,
    pub(crate) conflict: f64,
    pub(crate) same_side: f64,
    pub(crate) opposite_side: f64,
    /// Σ d² over hits, d the distance of each, cubic metres.
    pub(crate) scatter: f64,
    /// Σ n nᵀ over hits from the same side.
    pub(crate) spread: Matrix2<f64>,
}

/// What the patches of a map meet, each where it lies.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PatchSums {
    pub(crate) counts: WallCounts,
    /// Metres of hits across the weaker direction of each patch.
    pub(crate) cross: f64,
    /// Patches that fit, each as far as it does.
    pub(crate) fitting: f64,
}

impl PatchSums {
    /// Of `map` as one piece, by at most `most` of its walls.
    pub(crate) fn rigid(
        map: &PreparedMap,
        on: &PreparedMap,
        on_from_map: &Se2,
        reach: Reach,
        most: usize,
    ) -> Self {
        let used = map.walls.len().min(most);
        let length = map.wall_length() / used.max(1) as f64;
        let mut sums = Self::default();
        for patch in &map.patches {
            let mut of_patch = WallCounts::default();
            of_patch.add(patch.walls(most), on, on_from_map, reach, length);
            sums.add(&of_patch);
        }
        sums
    }

    pub(crate) fn add(&mut self, of_patch: &WallCounts) {
        self.counts.merge(of_patch);
        self.cross += of_patch.cross();
        self.fitting += of_patch.fitting();
    }
}

impl WallCounts {
    /// Adds `walls`, each of `length` metres.
    pub(crate) fn add(
        &mut self,
        walls: &[WallPoint],
        on: &PreparedMap,
        on_from_map: &Se2,
        reach: Reach,
        length: f64,
    ) {
        for wall in walls {
            let at = *on_from_map * wall.at;
            let Some((Slope { value: distance, .. }, there)) = on.surroundings(at) else {
                continue;
            };
            if distance <= reach.hit {
                self.hit += length;
                self.scatter += length * distance * distance;
                let facing = wall.facing.turned(|normal| *on_from_map * normal);
                self.add_side(facing, there.side.facing(), length);
            } else if there.state == State::Free {
                if distance <= reach.near {
                    self.near_miss += length;
                } else {
                    self.conflict += length;
                }
            }
        }
    }

    /// Metres of hits that resist a shift in the direction that they resist least.
    fn cross(&self) -> f64 {
        self.spread.symmetric_eigenvalues().min().max(0.0)
    }

    pub(crate) fn fit(&self) -> WallFit {
        WallFit { hit_m: self.hit, near_miss_m: self.near_miss, conflict_m: self.conflict }
    }

    /// Metres that fit less those that do not.
    fn margin(&self) -> f64 {
        self.hit - self.near_miss - self.conflict
    }

    /// From 0 to 1: a patch fits where its hits are more than twice its conflicts, and by how much
    /// more hardly matters, for much wall in one place is mostly one long wall. Near misses count in
    /// the score by themselves.
    fn fitting(&self) -> f64 {
        let beyond = (self.hit - AGAINST * self.conflict).max(0.0);
        beyond / (beyond + HALF_FITS_M)
    }

    /// Whether walls fit better than `other` of the same walls: more fit, or as many and closer.
    pub(crate) fn fits_better_than(&self, other: &Self) -> bool {
        let (margin, scatter) = (self.margin(), self.scatter);
        margin > other.margin() || (margin == other.margin() && scatter < other.scatter)
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        self.hit += other.hit;
        self.near_miss += other.near_miss;
        self.conflict += other.conflict;
        self.same_side += other.same_side;
        self.opposite_side += other.opposite_side;
        self.scatter += other.scatter;
        self.spread += other.spread;
    }

    fn add_side(&mut self, facing: Facing, other: Facing, length: f64) {
        let agreement = facing.agreement(other);
        if agreement > 0.0 {
            self.same_side += length * agreement;
            self.spread += facing.normal * facing.normal.transpose() * length;
        } else {
            self.opposite_side -= length * agreement;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PatchSums, WallCounts};
    use proptest::prelude::{prop_assert, proptest};

    fn fitting(patches: &[WallCounts]) -> f64 {
        let mut sums = PatchSums::default();
        patches.iter().for_each(|patch| sums.add(patch));
        sums.fitting
    }

    proptest! {
        #[test]
        fn a_part_fits_more_with_every_hit_and_less_with_every_conflict(
            hit in 0.0_f64..20.0, conflict in 0.0_f64..20.0, more in 0.1_f64..5.0,
        ) {
            let of = |hit, conflict| fitting(&[WallCounts { hit, conflict, ..Default::default() }]);
            let before = of(hit, conflict);
            prop_assert!((0.0..1.0).contains(&before) && (before > 0.0) == (hit > 2.0 * conflict));
            prop_assert!(of(hit + more, conflict) >= before);
            prop_assert!(of(hit, conflict + more) <= before);
        }

        #[test]
        fn the_same_wall_in_more_places_says_more(hit in 0.5_f64..20.0, places in 2_u8..10) {
            let patch = |hit| WallCounts { hit, ..Default::default() };
            let spread = vec![patch(hit / f64::from(places)); usize::from(places)];
            prop_assert!(fitting(&spread) > 1.05 * fitting(&[patch(hit)]));
        }
    }
}
