//! From which side every wall was seen.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use nalgebra::{Matrix2, Vector2};

use crate::lattice::{Lattice, floor_index};
use crate::state::State;

/// Width over which the free space at a wall is weighed, metres, and never less than these cells.
const SIGMA_M: f64 = 0.08;
const SIGMA_CELLS: f64 = 1.2;
/// On cells below 6 mm less will do, for the window grows with the square.
const MOST_SIGMA_CELLS: f64 = 13.0;
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

/// Cells around every wall that are looked at, to all sides.
pub(crate) fn margin(resolution: f64) -> usize {
    window_radius(window_sigma(resolution)).max(ring_reach(resolution))
}

/// The side of the nearest wall for every cell, near walls; around all walls there must be at least
/// the [`margin`].
pub(crate) fn sides(state: &[State], lattice: &Lattice) -> Vec<Side> {
    let window = Window::new(lattice);
    let mut sides = vec![Side::UNKNOWN; state.len()];
    let rings = rings(lattice);
    // Squared cells to the wall that a side was taken from.
    let mut taken = vec![u8::MAX; state.len()];
    for (at, _) in state.iter().enumerate().filter(|&(_, &cell)| cell == State::Wall) {
        let side = Side::of(window.facing(state, at));
        for &(offset, distance) in &rings {
            let near = at.wrapping_add_signed(offset);
            if distance < taken[near] {
                taken[near] = distance;
                sides[near] = side;
            }
        }
    }
    sides
}

/// Cells.
fn ring_reach(resolution: f64) -> usize {
    floor_index((REACH_M / resolution).ceil()).min(15)
}

/// Cells.
fn window_sigma(resolution: f64) -> f64 {
    (SIGMA_M / resolution).clamp(SIGMA_CELLS, MOST_SIGMA_CELLS)
}

/// Cells.
fn window_radius(sigma: f64) -> usize {
    floor_index((2.5 * sigma).ceil())
}

/// Offsets of the cells within reach, with a rank that grows with their length.
fn rings(lattice: &Lattice) -> Vec<(isize, u8)> {
    let reach = ring_reach(lattice.resolution).cast_signed();
    let mut offsets: Vec<(isize, u8)> = (-reach..=reach)
        .flat_map(|dy| (-reach..=reach).map(move |dx| (dx, dy)))
        .filter(|&(dx, dy)| dx * dx + dy * dy <= reach * reach)
        .map(|(dx, dy)| {
            let rank = u8::try_from(dx * dx + dy * dy).unwrap_or(u8::MAX - 1);
            (dx + dy * lattice.width.cast_signed(), rank)
        })
        .collect();
    offsets.sort_by_key(|&(_, rank)| rank);
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
    /// From the middle, in the order of the cells of the map.
    offset: isize,
    /// The weights sum to one.
    value: f64,
    /// Offset of the cell, times its weight.
    pull: Vector2<f64>,
    /// The offset times itself, times its weight.
    spread: Matrix2<f64>,
}

impl Window {
    fn new(lattice: &Lattice) -> Self {
        let sigma = window_sigma(lattice.resolution);
        let radius = window_radius(sigma).cast_signed();
        let weight =
            |dx: isize, dy: isize| (-0.5 * ((dx * dx + dy * dy) as f64) / (sigma * sigma)).exp();
        let cells = (-radius..=radius).flat_map(|dy| (-radius..=radius).map(move |dx| (dx, dy)));
        let total: f64 = cells.clone().map(|(dx, dy)| weight(dx, dy)).sum();
        let hidden: f64 = (-radius..=radius).map(|dy| weight(0, dy) / total).sum();
        let weights: Vec<Weight> = cells
            .map(|(dx, dy)| {
                let value = weight(dx, dy) / total;
                let offset = Vector2::new(dx as f64, dy as f64);
                Weight {
                    offset: dx + dy * lattice.width.cast_signed(),
                    value,
                    pull: offset * value,
                    spread: offset * offset.transpose() * value,
                }
            })
            .collect();
        let one = 0.5 * (1.0 - hidden);
        let open_share = 0.5 * (one + 1.0 - hidden);
        Self { weights, sigma, open_share }
    }

    /// Into which free space the wall at a cell faces.
    fn facing(&self, state: &[State], at: usize) -> Facing {
        let mut free = 0.0;
        let mut pull = Vector2::zeros();
        let mut spread = Matrix2::zeros();
        for weight in &self.weights {
            match state[at.wrapping_add_signed(weight.offset)] {
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

#[cfg(test)]
mod tests {
    use super::{margin, sides};
    use crate::lattice::Lattice;
    use crate::state::State;
    use nalgebra::Vector2;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn a_wall_faces_the_side_from_which_it_was_seen_on_cells_of_any_size(power in -4.0_f64..3.0) {
            let resolution = 10.0_f64.powf(power);
            let around = margin(resolution) + 1;
            let size = 2 * around + 1;
            // A wall from below to above, free on its right up to the edge.
            let state: Vec<State> = (0..size * size)
                .map(|at| match (at % size).cmp(&around) {
                    std::cmp::Ordering::Less => State::Unknown,
                    std::cmp::Ordering::Equal if (around..size - around).contains(&(at / size)) => {
                        State::Wall
                    }
                    _ => State::Free,
                })
                .collect();
            let lattice = Lattice::new(size, size, resolution);
            let facing = sides(&state, &lattice)[around * size + around].facing();
            prop_assert!(!facing.is_open_behind, "{facing:?}");
            prop_assert!(facing.normal.dot(&Vector2::x()) > 0.99, "{facing:?}");
        }
    }
}
