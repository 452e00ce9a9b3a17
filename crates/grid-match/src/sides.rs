//! From which side every wall was seen.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use nalgebra::{Matrix2, Vector2};

use crate::lattice::{Lattice, floor_index};
use crate::state::State;

/// Width over which the free space at a wall is weighed, metres, and never less than these cells.
const SIGMA_M: f64 = 0.08;
const SIGMA_CELLS: f64 = 1.2;
/// Share of the slope at a wall seen from one side alone below which no side is meant.
const FLAT: f64 = 0.2;
/// A side is that of the nearest wall up to here, metres.
const REACH_M: f64 = 0.2;
/// Directions that are told apart; a multiple of four, so that a quarter turn loses nothing.
const DIRECTIONS: u8 = 120;

/// From which side the nearest wall was seen, in one byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Side(u8);

/// Into which free space a wall faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facing {
    /// Unit vector into free space, across the wall; zero where nobody knows.
    pub(crate) normal: Vector2<f64>,
    /// Whether the other side is free as well.
    pub(crate) is_open_behind: bool,
}

impl Facing {
    pub(crate) const UNKNOWN: Self = Self { normal: Vector2::new(0.0, 0.0), is_open_behind: false };

    /// Cosine of the angle between two walls by the sides that were seen: negative where they were
    /// seen from opposite sides, zero where nobody knows.
    #[inline]
    pub(crate) fn agreement(self, other: Self) -> f64 {
        let cosine = self.normal.dot(&other.normal);
        if self.is_open_behind || other.is_open_behind { cosine.abs() } else { cosine }
    }

    /// As seen after a turn.
    #[inline]
    pub(crate) fn turned(self, by: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Self {
        Self { normal: by(self.normal), ..self }
    }
}

static FACINGS: LazyLock<Vec<Facing>> = LazyLock::new(|| {
    let facing = |step: u8| {
        let is_open_behind = step >= DIRECTIONS;
        let (sin, cos) = (f64::from(step) * TAU / f64::from(DIRECTIONS)).sin_cos();
        Facing { normal: Vector2::new(cos, sin), is_open_behind }
    };
    let known = (0..DIRECTIONS + DIRECTIONS / 2).map(facing);
    known.chain([Facing::UNKNOWN]).collect()
});

impl Side {
    const UNKNOWN: Self = Self(DIRECTIONS + DIRECTIONS / 2);

    #[inline]
    pub(crate) fn facing(self) -> Facing {
        FACINGS[usize::from(self.0)]
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to DIRECTIONS")]
    fn of(facing: Facing) -> Self {
        if facing.normal == Vector2::zeros() {
            return Self::UNKNOWN;
        }
        let angle = facing.normal.y.atan2(facing.normal.x);
        let steps = |period: f64, of: u8| {
            let step = (angle.rem_euclid(period) / period * f64::from(of)).round() as u8;
            step % of
        };
        Self(if facing.is_open_behind {
            DIRECTIONS + steps(PI, DIRECTIONS / 2)
        } else {
            steps(TAU, DIRECTIONS)
        })
    }
}

/// The side of the nearest wall for every cell, near walls.
pub(crate) fn sides(state: &[State], lattice: &Lattice) -> Vec<Side> {
    let window = Window::new(lattice.resolution);
    let mut sides = vec![Side::UNKNOWN; state.len()];
    // Squared cells to the wall that a side was taken from.
    let reach = floor_index((REACH_M / lattice.resolution).ceil());
    let rings = rings(reach);
    let mut taken = vec![u8::MAX; state.len()];
    for (at, _) in state.iter().enumerate().filter(|&(_, &cell)| cell == State::Wall) {
        let side = Side::of(window.facing(state, lattice, at));
        let (column, row) = (at % lattice.width, at / lattice.width);
        for &(dx, dy, distance) in &rings {
            let (x, y) = (column.wrapping_add_signed(dx), row.wrapping_add_signed(dy));
            if x >= lattice.width || y >= lattice.height {
                continue;
            }
            let near = y * lattice.width + x;
            if distance < taken[near] {
                taken[near] = distance;
                sides[near] = side;
            }
        }
    }
    sides
}

/// Offsets of up to `reach` cells, with a rank that grows with their length.
fn rings(reach: usize) -> Vec<(isize, isize, u8)> {
    let reach = isize::try_from(reach.min(15)).unwrap_or(15);
    let mut offsets: Vec<(isize, isize, u8)> = (-reach..=reach)
        .flat_map(|dy| (-reach..=reach).map(move |dx| (dx, dy, dx * dx + dy * dy)))
        .filter(|&(_, _, square)| square <= reach * reach)
        .map(|(dx, dy, square)| (dx, dy, u8::try_from(square).unwrap_or(u8::MAX - 1)))
        .collect();
    offsets.sort_by_key(|&(_, _, rank)| rank);
    offsets
}

/// What lies around a cell, weighed by a Gaussian.
struct Window {
    weights: Vec<Weight>,
    sigma: f64,
    /// Between what a wall of one cell shows that was seen from one side, and from both.
    open_share: f64,
}

/// One cell of a window.
struct Weight {
    column: isize,
    row: isize,
    /// The weights sum to one.
    value: f64,
    /// Offset of the cell, times its weight.
    pull: Vector2<f64>,
    /// The offset times itself, times its weight.
    spread: Matrix2<f64>,
}

impl Window {
    fn new(resolution: f64) -> Self {
        let sigma = (SIGMA_M / resolution).max(SIGMA_CELLS);
        #[expect(clippy::cast_possible_truncation, reason = "some cells")]
        let radius = (2.5 * sigma).ceil() as isize;
        let weight =
            |dx: isize, dy: isize| (-0.5 * ((dx * dx + dy * dy) as f64) / (sigma * sigma)).exp();
        let cells = (-radius..=radius).flat_map(|dy| (-radius..=radius).map(move |dx| (dx, dy)));
        let total: f64 = cells.clone().map(|(dx, dy)| weight(dx, dy)).sum();
        let weights: Vec<Weight> = cells
            .map(|(column, row)| {
                let value = weight(column, row) / total;
                let offset = Vector2::new(column as f64, row as f64);
                let spread = offset * offset.transpose() * value;
                Weight { column, row, value, pull: offset * value, spread }
            })
            .collect();
        let of_column = weights.iter().filter(|weight| weight.column == 0);
        let hidden: f64 = of_column.map(|weight| weight.value).sum();
        let one = 0.5 * (1.0 - hidden);
        let open_share = 0.5 * (one + 1.0 - hidden);
        Self { weights, sigma, open_share }
    }

    /// Into which free space the wall at a cell faces.
    fn facing(&self, state: &[State], lattice: &Lattice, at: usize) -> Facing {
        let (column, row) = (at % lattice.width, at / lattice.width);
        let mut free = 0.0;
        let mut pull = Vector2::zeros();
        let mut spread = Matrix2::zeros();
        for weight in &self.weights {
            let x = column.wrapping_add_signed(weight.column);
            let y = row.wrapping_add_signed(weight.row);
            // What would lie left of or below the map wraps to far beyond it.
            if x >= lattice.width || y >= lattice.height {
                continue;
            }
            match state[y * lattice.width + x] {
                State::Free => {
                    free += weight.value;
                    pull += weight.pull;
                }
                State::Wall => spread += weight.spread,
                State::Unknown => {}
            }
        }
        // Half of the plane pulls by σ/√(2π).
        let slope = pull.norm() * TAU.sqrt() / self.sigma;
        if free > self.open_share {
            let eigen = spread.symmetric_eigen();
            let across = if eigen.eigenvalues[0] < eigen.eigenvalues[1] { 0 } else { 1 };
            let has_direction = eigen.eigenvalues.max() > 2.0 * eigen.eigenvalues.min();
            let normal: Vector2<f64> = eigen.eigenvectors.column(across).into();
            if has_direction {
                return Facing { normal, is_open_behind: true };
            }
        }
        if slope > FLAT {
            Facing { normal: pull.normalize(), is_open_behind: false }
        } else {
            Facing::UNKNOWN
        }
    }
}
