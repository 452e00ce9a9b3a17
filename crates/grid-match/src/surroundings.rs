//! What a map says at a place, in one record, for a match asks for all of it at once.

use nalgebra::Point2;

use crate::lattice::{Lattice, Slope};
use crate::sides::Side;
use crate::state::State;

/// Distances are cut off here, metres: twice what the widest refinement still weighs.
pub(crate) const FARTHEST_M: f64 = 2.0;
/// Distances are kept in steps of 0.03 mm, so that a cell takes four bytes.
const STEP_M: f64 = FARTHEST_M / u16::MAX as f64;

/// How far the nearest wall is, cut off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Distance(u16);

/// What a map says of a cell and of the wall next to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surroundings {
    pub(crate) distance: Distance,
    /// From which side the nearest wall was seen, near walls.
    pub(crate) side: Side,
    pub(crate) state: State,
}

impl Distance {
    pub(crate) const ZERO: Self = Self(0);
    pub(crate) const FARTHEST: Self = Self(u16::MAX);

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and what is too far for the steps is cut off"
    )]
    pub(crate) fn of_metres(metres: f32) -> Self {
        Self((metres * (1.0 / STEP_M) as f32 + 0.5) as u16)
    }

    #[inline]
    pub(crate) fn metres(self) -> f64 {
        self.steps() * STEP_M
    }

    #[inline]
    fn steps(self) -> f64 {
        f64::from(self.0)
    }
}

/// How far the nearest wall is from `point` and how that changes, and what else is said there;
/// `None` outside of the map.
#[inline(always)]
#[expect(clippy::inline_always, reason = "the innermost call of a match")]
pub(crate) fn surroundings(
    cells: &[Surroundings],
    lattice: &Lattice,
    point: Point2<f64>,
) -> Option<(Slope, Surroundings)> {
    let corners = lattice.corners(point)?;
    let steps = corners.slope(|cell| cells[cell].distance.steps());
    let slope = Slope { value: steps.value * STEP_M, gradient: steps.gradient * STEP_M };
    Some((slope, cells[corners.nearest()]))
}
