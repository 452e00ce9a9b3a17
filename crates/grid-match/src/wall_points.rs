//! Points on walls, evenly spread, each with the side from which it was seen.

use nalgebra::{Point2, Vector2};

use crate::lattice::{Lattice, floor_index};
use crate::sides::{Facing, Side};
use crate::state::State;

/// Counts of points that are used, least first: so many of them from the first on are a fair sample,
/// and in the order of the map, for then what is looked up for one is close to that for the next.
pub(crate) const LEVELS: [usize; 4] = [400, 1000, 3000, 20_000];

/// A point on a wall, local frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallPoint {
    pub(crate) at: Point2<f64>,
    pub(crate) facing: Facing,
}

/// Where the walls of a map are.
pub(crate) struct Walls<'a> {
    pub(crate) state: &'a [State],
    pub(crate) sides: &'a [Side],
    pub(crate) lattice: &'a Lattice,
    /// Of each cell, in 1/200 of its side; empty for none.
    pub(crate) offsets: &'a [[i8; 2]],
}

impl Walls<'_> {
    /// One point for each square of `spacing` that holds wall, the mean of its cells, in the order of
    /// [`LEVELS`].
    pub(crate) fn points(&self, spacing: f64) -> Vec<WallPoint> {
        let lattice = self.lattice;
        let columns = floor_index(lattice.width as f64 * lattice.resolution / spacing) + 1;
        let cells = self.state.iter().enumerate().filter(|&(_, &state)| state == State::Wall);
        let mut walls: Vec<(u64, usize)> = cells
            .map(|(at, _)| {
                let square = self.place(at) / spacing;
                ((floor_index(square.y) * columns + floor_index(square.x)) as u64, at)
            })
            .collect();
        walls.sort_unstable();
        let squares = walls.chunk_by(|a, b| a.0 == b.0);
        let mut points: Vec<(u64, WallPoint)> = squares
            .map(|cells| {
                let mut sum = Sum::default();
                for &(_, at) in cells {
                    sum.add(self.place(at), self.sides[at].facing());
                }
                (cells[0].0, sum.point())
            })
            .collect();
        points.sort_unstable_by_key(|&(index, _)| scatter(index));
        let count = points.len();
        let mut start = 0;
        for end in LEVELS.into_iter().chain([count]).map(|end| end.min(count)) {
            points[start..end].sort_unstable_by_key(|&(index, _)| index);
            start = end;
        }
        points.into_iter().map(|(_, point)| point).collect()
    }

    fn place(&self, at: usize) -> Point2<f64> {
        let centre = self.lattice.centre(at);
        match self.offsets.get(at) {
            Some(&[x, y]) => {
                let offset = Vector2::new(f64::from(x), f64::from(y)) / 200.0;
                centre + offset * self.lattice.resolution
            }
            None => centre,
        }
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    cells: u32,
    place: Vector2<f64>,
    /// Of the sides of walls seen from one, and of those seen from both.
    one: Vector2<f64>,
    both: Vector2<f64>,
    known: u32,
}

impl Sum {
    fn add(&mut self, place: Point2<f64>, facing: Facing) {
        self.cells += 1;
        self.place += place.coords;
        if facing.normal == Vector2::zeros() {
            return;
        }
        self.known += 1;
        if facing.is_open_behind {
            let sign = if self.both.dot(&facing.normal) < 0.0 { -1.0 } else { 1.0 };
            self.both += facing.normal * sign;
        } else {
            self.one += facing.normal;
        }
    }

    fn point(&self) -> WallPoint {
        let at = Point2::from(self.place / f64::from(self.cells));
        let (one, both) = (self.one.norm(), self.both.norm());
        let facing = if both > one {
            Facing { normal: self.both / both, is_open_behind: true }
        } else if one > 0.3 * f64::from(self.known) {
            Facing { normal: self.one / one, is_open_behind: false }
        } else {
            Facing::UNKNOWN
        };
        WallPoint { at, facing }
    }
}

/// The finaliser of SplitMix64: a bijection, so no two indices tie.
pub(crate) fn scatter(index: u64) -> u64 {
    let mut bits = index.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
