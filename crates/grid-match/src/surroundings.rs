//! What a map says at a place, in one record, for a match asks for all of it at once.

use nalgebra::Point2;

use crate::lattice::{Lattice, Slope};
use crate::sides::Side;
use crate::state::State;

/// What a map says of a cell and of the wall next to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surroundings {
    /// Metres to the nearest wall, cut off.
    pub(crate) distance: f32,
    /// From which side the nearest wall was seen, near walls.
    pub(crate) side: Side,
    pub(crate) state: State,
}

/// How far the nearest wall is from `point` and how that changes, and what else is said there;
/// `None` outside of the map.
#[inline]
pub(crate) fn surroundings(
    cells: &[Surroundings],
    lattice: &Lattice,
    point: Point2<f64>,
) -> Option<(Slope, Surroundings)> {
    let corners = lattice.corners(point)?;
    let slope = corners.slope(|cell| f64::from(cells[cell].distance));
    Some((slope, cells[corners.nearest()]))
}
