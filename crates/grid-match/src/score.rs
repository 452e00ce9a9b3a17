//! How well two maps fit under a pose, in metres of wall.

use nalgebra::{Matrix2, Rotation2, Vector2};
use ogm_core::Se2;

use crate::prepare::{PreparedMap, State};

/// What a pose has for it and against it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Evidence {
    /// Wall of one map on wall of the other, metres, mean of both directions.
    pub hit_m: f64,
    /// Wall of one map close to wall of the other, but in its free space, metres.
    pub near_miss_m: f64,
    /// Wall of one map in free space of the other, far from any wall, metres.
    pub conflict_m: f64,
    /// Free in both, square metres.
    pub free_m2: f64,
    /// Known in both over known in the smaller one.
    pub overlap: f64,
    /// Of [`hit_m`](Self::hit_m), seen from the same side.
    pub same_side_m: f64,
    /// Of [`hit_m`](Self::hit_m), seen from opposite sides, as two rooms behind one wall do.
    pub opposite_side_m: f64,
    /// Metres of matched wall that resist a shift in the direction that walls resist least; near
    /// zero in a corridor.
    pub cross_m: f64,
}

impl Evidence {
    /// Whether enough of both maps lies on each other to say anything: free space on free space,
    /// and walls seen from the same side.
    #[must_use]
    pub fn is_comparable(&self) -> bool {
        let sided = self.same_side_m + self.opposite_side_m;
        self.free_m2 >= 0.5 && self.same_side_m >= 0.5 && self.same_side_m >= 0.4 * sided
    }

    /// Share of the compared wall that fits.
    #[must_use]
    pub fn agreement(&self) -> f64 {
        let compared = self.hit_m + self.near_miss_m + self.conflict_m;
        if compared > 0.0 { self.hit_m / compared } else { 0.0 }
    }

    /// Log-odds that the pose is right against that no pose is; −12 for what cannot be compared.
    ///
    /// Fitted by a conditional logit on simulated pairs: right poses, wrong poses of pairs that
    /// match, and pairs of different buildings, with drift, bends and moved furniture. More wall
    /// than there was in those counts in proportion, not in full.
    #[must_use]
    pub fn score(&self) -> f64 {
        if !self.is_comparable() {
            return -12.0;
        }
        let against = self.near_miss_m + self.conflict_m;
        let fit = ((self.hit_m + 0.5) / (against + 1.0)).ln();
        let share = (FITTED_WALL_M / (self.hit_m + against)).min(1.0);
        1.52 * fit + 4.68 * (share * self.free_m2).ln_1p()
            - 3.34 * (share * self.conflict_m).ln_1p()
            - 13.03
    }
}

/// Most metres of compared wall in the pairs that the score was fitted on.
const FITTED_WALL_M: f64 = 150.0;

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

/// Metres of wall that fit less those that contradict, on at most `most` points of each map: what
/// is worth a closer look.
pub(crate) fn quick_score(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> f64 {
    let forth = Tally::of(second, first, first_from_second, reach, most);
    let back = Tally::of(first, second, &first_from_second.inverse(), reach, most);
    0.5 * (forth.hit + back.hit) * 1.16 - 0.5 * (forth.conflict + back.conflict) * 1.32
}

/// All that is known about a pose.
pub(crate) fn evidence(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> Evidence {
    let forth = Tally::of(second, first, first_from_second, reach, most);
    let back = Tally::of(first, second, &first_from_second.inverse(), reach, most);
    let [mut free, mut known] = [0_u32, 0];
    for sample in &second.samples {
        let Some(cell) = first.lattice.index(*first_from_second * sample.at) else { continue };
        known += u32::from(first.state[cell] != State::Unknown);
        free += u32::from(first.state[cell] == State::Free && sample.free);
    }
    let smaller = first.known_area().min(second.known_area());
    // The normals of the second tally are in the frame of the second map.
    let turn = Rotation2::new(first_from_second.theta()).into_inner();
    let spread = (forth.spread + turn * back.spread * turn.transpose()) * 0.5;
    let mean = |value: fn(&Tally) -> f64| 0.5 * (value(&forth) + value(&back));
    Evidence {
        hit_m: mean(|tally| tally.hit),
        near_miss_m: mean(|tally| tally.near_miss),
        conflict_m: mean(|tally| tally.conflict),
        free_m2: f64::from(free) * second.sample_area,
        overlap: (f64::from(known) * second.sample_area / smaller).min(1.0),
        same_side_m: mean(|tally| tally.same_side),
        opposite_side_m: mean(|tally| tally.opposite_side),
        cross_m: spread.symmetric_eigenvalues().min().max(0.0),
    }
}

/// Metres of wall of one map by what the other says there.
#[derive(Default)]
struct Tally {
    hit: f64,
    near_miss: f64,
    conflict: f64,
    same_side: f64,
    opposite_side: f64,
    /// Σ n nᵀ over hits from the same side.
    spread: Matrix2<f64>,
}

impl Tally {
    fn of(
        map: &PreparedMap,
        on: &PreparedMap,
        on_from_map: &Se2,
        reach: Reach,
        most: usize,
    ) -> Self {
        let mut tally = Self::default();
        let used = map.walls.len().min(most);
        let length = map.wall_length() / used.max(1) as f64;
        for wall in &map.walls[..used] {
            let at = *on_from_map * wall.at;
            let Some(distance) = on.lattice.slope(&on.distance, at).map(|slope| slope.value) else {
                continue;
            };
            let Some(cell) = on.lattice.index(at) else { continue };
            if distance <= reach.hit {
                tally.hit += length;
                let normal = *on_from_map * wall.normal;
                tally.add_side(normal, on.lattice.direction(&on.openness, cell), length);
            } else if on.state[cell] == State::Free {
                if distance <= reach.near {
                    tally.near_miss += length;
                } else {
                    tally.conflict += length;
                }
            }
        }
        tally
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
