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

impl WallCounts {
    pub(crate) fn of(
        map: &PreparedMap,
        on: &PreparedMap,
        on_from_map: &Se2,
        reach: Reach,
        most: usize,
    ) -> Self {
        let mut counts = Self::default();
        let used = &map.walls[..map.walls.len().min(most)];
        let length = map.wall_length() / used.len().max(1) as f64;
        counts.add(used, on, on_from_map, reach, length);
        counts
    }

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
    pub(crate) fn cross(&self) -> f64 {
        self.spread.symmetric_eigenvalues().min().max(0.0)
    }

    pub(crate) fn fit(&self) -> WallFit {
        WallFit { hit_m: self.hit, near_miss_m: self.near_miss, conflict_m: self.conflict }
    }

    /// Metres that fit less those that do not.
    fn margin(&self) -> f64 {
        self.hit - self.near_miss - self.conflict
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
