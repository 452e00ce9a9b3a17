//! What the walls of one map meet in another.

use nalgebra::{Matrix2, Vector2};
use ogm_core::Se2;

use crate::crop::State;
use crate::prepare::PreparedMap;
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
#[derive(Default)]
pub(crate) struct WallCounts {
    pub(crate) hit: f64,
    pub(crate) near_miss: f64,
    pub(crate) conflict: f64,
    pub(crate) same_side: f64,
    pub(crate) opposite_side: f64,
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
            let Some(distance) = on.lattice.slope(&on.distance, at).map(|slope| slope.value) else {
                continue;
            };
            let Some(cell) = on.lattice.index(at) else { continue };
            if distance <= reach.hit {
                self.hit += length;
                let normal = *on_from_map * wall.normal;
                self.add_side(normal, on.lattice.direction(&on.openness, cell), length);
            } else if on.state[cell] == State::Free {
                if distance <= reach.near {
                    self.near_miss += length;
                } else {
                    self.conflict += length;
                }
            }
        }
    }

    fn add_side(&mut self, normal: Vector2<f64>, other: Vector2<f64>, length: f64) {
        let agreement = normal.dot(&other);
        if agreement > 0.0 {
            self.same_side += length * agreement;
            self.spread += normal * normal.transpose() * length;
        } else {
            self.opposite_side -= length * agreement;
        }
    }
}
