//! Walls and free space of a map on a coarse lattice, packed for one complex correlation.

use nalgebra::{Matrix2, Point2, Rotation2, SymmetricEigen, Vector2};
use rustfft::num_complex::Complex32;

use crate::lattice::floor_index;
use crate::prepare::PreparedMap;
use crate::smooth::smooth_rows_and_columns;
use crate::state::State;

/// What wall on wall, wall on free space and free space on free space count.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Weights {
    /// Wall on wall.
    pub(crate) walls: f64,
    /// Wall on free space, taken off.
    pub(crate) conflict: f64,
    /// Free space on free space.
    pub(crate) free: f64,
}

/// Fitted on simulated pairs.
pub(crate) const WEIGHTS: Weights = Weights { walls: 1.0, conflict: 0.25, free: 0.03 };

/// A map turned by some angle, as one complex number a coarse cell.
#[derive(Debug, Clone)]
pub(crate) struct CorrelationPlanes {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Turned point of the lower-left corner of cell (0, 0).
    pub(crate) origin: Vector2<f64>,
    pub(crate) packed: Vec<Complex32>,
}

/// Which side of a correlation a map is on; the packed numbers differ by a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    First,
    Second,
}

/// Share of free cells in each coarse cell, unturned.
#[derive(Debug, Clone)]
pub(crate) struct FreeShare {
    cell: f64,
    width: usize,
    height: usize,
    share: Vec<f32>,
}

impl FreeShare {
    #[expect(clippy::cast_possible_truncation, reason = "a share in single precision")]
    pub(crate) fn of(map: &PreparedMap, cell: f64) -> Self {
        let lattice = &map.lattice;
        let coarse = |fine: usize| floor_index((fine as f64 + 0.5) * lattice.resolution / cell);
        let (width, height) = (coarse(lattice.width - 1) + 1, coarse(lattice.height - 1) + 1);
        let mut share = vec![0.0_f32; width * height];
        let part = (lattice.resolution / cell).powi(2) as f32;
        let columns: Vec<usize> = (0..lattice.width).map(coarse).collect();
        for (row, cells) in map.cells.chunks_exact(lattice.width).enumerate() {
            let output = &mut share[coarse(row) * width..][..width];
            for (&column, there) in columns.iter().zip(cells) {
                if there.state == State::Free {
                    output[column] += part;
                }
            }
        }
        for value in &mut share {
            *value = value.min(1.0);
        }
        Self { cell, width, height, share }
    }

    /// Bilinear, zero outside; `place` in cells from the middle of the first.
    fn at(&self, place: Vector2<f64>) -> f32 {
        let (x, y) = (place.x, place.y);
        let inside =
            x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f64 && y < (self.height - 1) as f64;
        if !inside {
            return 0.0;
        }
        let (column, row) = (floor_index(x), floor_index(y));
        #[expect(clippy::cast_possible_truncation, reason = "fractions in single precision")]
        let (right, up) = ((x - column as f64) as f32, (y - row as f64) as f32);
        let at = row * self.width + column;
        let low = self.share[at] * (1.0 - right) + self.share[at + 1] * right;
        let above = at + self.width;
        let high = self.share[above] * (1.0 - right) + self.share[above + 1] * right;
        low * (1.0 - up) + high * up
    }
}

impl CorrelationPlanes {
    /// `map` turned by `theta` on cells of `free.cell` metres.
    pub(crate) fn turned(map: &PreparedMap, free: &FreeShare, theta: f64, side: Side) -> Self {
        let cell = free.cell;
        let turn = Rotation2::new(theta);
        let (origin, [width, height]) = turned_lattice(map, theta, cell);

        let walls = wall_share(map, theta, origin, cell, [width, height]);
        let near_wall = grown(&walls, width);
        let walls = smooth_rows_and_columns(walls, width, 1.0);
        let axes = Axes::new(&WEIGHTS, side);
        let step = turn.inverse() * Vector2::x();
        let mut packed = Vec::with_capacity(width * height);
        for row in 0..height {
            let corner = origin + Vector2::new(0.5, row as f64 + 0.5) * cell;
            let start = turn.inverse() * corner / cell - Vector2::repeat(0.5);
            for column in 0..width {
                let at = row * width + column;
                let free = if near_wall[at] { 0.0 } else { free.at(start + step * column as f64) };
                packed.push(axes.pack(walls[at], free));
            }
        }
        Self { width, height, origin, packed }
    }
}

/// Lower-left corner, columns and rows of the cells of `cell` metres that hold the known area
/// turned by `theta`, with a margin.
pub(crate) fn turned_lattice(
    map: &PreparedMap,
    theta: f64,
    cell: f64,
) -> (Vector2<f64>, [usize; 2]) {
    let [low, high] = turned_box(map, theta);
    let origin = low.coords - Vector2::repeat(2.0 * cell);
    let size = (high.coords - origin) / cell;
    (origin, [floor_index(size.x) + 3, floor_index(size.y) + 3])
}

/// The corners of the known area turned by `theta`.
pub(crate) fn turned_box(map: &PreparedMap, theta: f64) -> [Point2<f64>; 2] {
    let turn = Rotation2::new(theta);
    let start = turn * map.centre;
    let known = map.samples.iter().map(|sample| sample.at);
    let walls = map.walls.iter().map(|wall| wall.at);
    known.chain(walls).fold([start, start], |[low, high], at| {
        let at = turn * at;
        [low.inf(&at), high.sup(&at)]
    })
}

/// Metres of wall in each cell, in cell widths, at most one.
#[expect(clippy::cast_possible_truncation, reason = "a share in single precision")]
fn wall_share(
    map: &PreparedMap,
    theta: f64,
    origin: Vector2<f64>,
    cell: f64,
    [width, height]: [usize; 2],
) -> Vec<f32> {
    let mut share = vec![0.0_f32; width * height];
    let turn = Rotation2::new(theta);
    let part = (map.spacing / cell) as f32;
    for wall in &map.walls {
        let place = ((turn * wall.at).coords - origin) / cell;
        let (column, row) = (floor_index(place.x), floor_index(place.y));
        let value = &mut share[row * width + column];
        *value = (*value + part).min(1.0);
    }
    share
}

/// Whether a cell or one of its eight neighbours holds wall.
fn grown(walls: &[f32], width: usize) -> Vec<bool> {
    let mut near = vec![false; walls.len()];
    let height = walls.len() / width;
    for (at, _) in walls.iter().enumerate().filter(|&(_, &share)| share > 0.0) {
        let (column, row) = (at % width, at / width);
        for row in row.saturating_sub(1)..=(row + 1).min(height - 1) {
            let from = row * width + column.saturating_sub(1);
            let to = row * width + (column + 1).min(width - 1);
            near[from..=to].fill(true);
        }
    }
    near
}

/// The score [wall, free]·W·[wall, free] has one positive and one negative eigenvalue, so with
/// z = √λ₁ v₁·x ± i √|λ₂| v₂·x it is the real part of z_first · conj(z_second).
struct Axes {
    real: [f32; 2],
    imaginary: [f32; 2],
}

impl Axes {
    #[expect(clippy::cast_possible_truncation, reason = "weights in single precision")]
    fn new(weights: &Weights, side: Side) -> Self {
        let (walls, conflict, free) = (weights.walls, -weights.conflict, weights.free);
        let eigen = SymmetricEigen::new(Matrix2::new(walls, conflict, conflict, free));
        let (positive, negative) =
            if eigen.eigenvalues[0] > eigen.eigenvalues[1] { (0, 1) } else { (1, 0) };
        let axis = |index: usize| {
            let axis = eigen.eigenvectors.column(index) * eigen.eigenvalues[index].abs().sqrt();
            [axis[0] as f32, axis[1] as f32]
        };
        let sign = if side == Side::First { 1.0 } else { -1.0 };
        Self { real: axis(positive), imaginary: axis(negative).map(|part| sign * part) }
    }

    fn pack(&self, wall: f32, free: f32) -> Complex32 {
        let along = |axis: [f32; 2]| axis[0] * wall + axis[1] * free;
        Complex32::new(along(self.real), along(self.imaginary))
    }
}

#[cfg(test)]
mod tests {
    use super::{Axes, Side, WEIGHTS};
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn packed_numbers_multiply_to_the_weighted_sum(
            wall_a in 0.0_f32..1.0, free_a in 0.0_f32..1.0,
            wall_b in 0.0_f32..1.0, free_b in 0.0_f32..1.0,
        ) {
            let first = Axes::new(&WEIGHTS, Side::First).pack(wall_a, free_a);
            let second = Axes::new(&WEIGHTS, Side::Second).pack(wall_b, free_b);
            let [a, b, c, d] = [wall_a, free_a, wall_b, free_b].map(f64::from);
            let expected = WEIGHTS.walls * a * c - WEIGHTS.conflict * (a * d + b * c)
                + WEIGHTS.free * b * d;
            let found = f64::from((first * second.conj()).re);
            prop_assert!((found - expected).abs() < 1e-5, "{found} instead of {expected}");
        }
    }
}
