//! What the walls of one map meet in another.

use std::slice;

use nalgebra::Matrix2;
use ogm_core::Se2;

use crate::evidence::WallFit;
use crate::lattice::Slope;
use crate::patches::PLACES;
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

/// A metre of wall that misses takes off so many that fit, within a place.
const AGAINST: f64 = 2.0;
/// Metres of hits beyond that by which a place fits by half.
const HALF_FITS_M: f64 = 0.1;
/// Share of the hits of a place across their main direction with which it is a corner by half: the
/// normals of one straight wall scatter by about as much.
const HALF_CORNER: f64 = 0.1;

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
    /// Corners of wall that fit, each as far as it does.
    pub(crate) corners: f64,
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
            sums.add(patch.placed_walls(most), on, on_from_map, reach, length);
        }
        sums
    }

    /// Adds what the walls of a patch, each of `length` metres, meet.
    pub(crate) fn add<'a>(
        &mut self,
        placed_walls: impl Iterator<Item = (usize, &'a WallPoint)>,
        on: &PreparedMap,
        on_from_map: &Se2,
        reach: Reach,
        length: f64,
    ) {
        let mut places = [WallCounts::default(); PLACES];
        for (place, wall) in placed_walls {
            places[place].add(slice::from_ref(wall), on, on_from_map, reach, length);
        }
        for place in &places {
            self.counts.merge(place);
            self.corners += place.corner();
        }
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

    pub(crate) fn fit(&self) -> WallFit {
        WallFit { hit_m: self.hit, near_miss_m: self.near_miss, conflict_m: self.conflict }
    }

    /// Metres that fit less those that do not.
    fn margin(&self) -> f64 {
        self.hit - self.near_miss - self.conflict
    }

    /// From 0 to 1: a place is a corner that fits where its hits are more than twice what misses,
    /// by how much more hardly matters, and run in more than one direction. A straight wall slides
    /// along another, and is found in every building.
    fn corner(&self) -> f64 {
        let beyond = self.hit - AGAINST * (self.near_miss + self.conflict);
        if beyond <= 0.0 {
            return 0.0;
        }
        let across = self.spread.symmetric_eigenvalues().min().max(0.0) / self.hit;
        beyond / (beyond + HALF_FITS_M) * (across / (across + HALF_CORNER))
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
    use super::WallCounts;
    use nalgebra::Matrix2;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    fn corner(along: f64, across: f64, near_miss: f64, conflict: f64) -> f64 {
        let spread = Matrix2::new(along, 0.0, 0.0, across);
        WallCounts { hit: along + across, near_miss, conflict, spread, ..Default::default() }
            .corner()
    }

    proptest! {
        #[test]
        fn a_place_is_more_of_a_corner_the_more_fits_and_less_the_more_misses(
            along in 0.5_f64..3.0, across in 0.01_f64..0.5, missed in 0.0_f64..2.0,
            more in 0.0_f64..1.0, times in 1.0_f64..3.0,
        ) {
            let before = corner(along, across, missed, 0.0);
            prop_assert!((0.0..1.0).contains(&before));
            prop_assert_eq!(before > 0.0, along + across > 2.0 * missed);
            prop_assert!(corner(along, (across + more).min(along), missed, 0.0) >= before);
            prop_assert!(corner(times * along, times * across, missed, 0.0) >= before);
            prop_assert!(corner(along, across, missed + more, 0.0) <= before);
            prop_assert!(corner(along, across, missed, more) <= before);
        }
    }

    #[test]
    fn a_straight_wall_is_no_corner() {
        assert_eq!(corner(2.0, 0.0, 0.0, 0.0), 0.0);
        assert!(corner(2.0, 0.02, 0.0, 0.0) < 0.1);
        assert!(corner(0.5, 0.5, 0.0, 0.0) > 0.7);
    }
}
