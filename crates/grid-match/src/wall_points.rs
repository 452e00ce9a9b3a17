//! Points on walls, evenly spread, each with the side from which it was seen.

use nalgebra::{Point2, Vector2};

use crate::crop::State;
use crate::lattice::{Lattice, floor_index};

/// A point on a wall, local frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallPoint {
    pub(crate) at: Point2<f64>,
    /// Unit vector into free space; zero where both sides are free, or none.
    pub(crate) normal: Vector2<f64>,
}

/// One point for each square of `spacing` that holds wall: the mean of its occupied cells.
pub(crate) fn wall_points(
    state: &[State],
    openness: &[f32],
    lattice: &Lattice,
    spacing: f64,
) -> Vec<WallPoint> {
    let columns = floor_index(lattice.width as f64 * lattice.resolution / spacing) + 1;
    let rows = floor_index(lattice.height as f64 * lattice.resolution / spacing) + 1;
    let mut sums = vec![(Vector2::zeros(), 0_u32); columns * rows];
    for (at, _) in state.iter().enumerate().filter(|&(_, &cell)| cell == State::Occupied) {
        let centre = lattice.centre(at);
        let (column, row) = (floor_index(centre.x / spacing), floor_index(centre.y / spacing));
        let (sum, cells) = &mut sums[row * columns + column];
        *sum += centre.coords;
        *cells += 1;
    }
    let mut points: Vec<(u64, WallPoint)> = (0_u64..)
        .zip(sums)
        .filter(|(_, (_, cells))| *cells > 0)
        .map(|(index, (sum, cells))| {
            let at = Point2::from(sum / f64::from(cells));
            let cell = lattice.index(at);
            let normal = cell.map_or_else(Vector2::zeros, |cell| lattice.direction(openness, cell));
            (scatter(index), WallPoint { at, normal })
        })
        .collect();
    points.sort_unstable_by_key(|&(order, _)| order);
    points.into_iter().map(|(_, point)| point).collect()
}

/// The finaliser of SplitMix64: a bijection, so no two indices tie.
fn scatter(index: u64) -> u64 {
    let mut bits = index.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
