//! Which lattice the output has, and where a map lies on it.

use nalgebra::Point2;
use ogm_core::{GridError, GridFrame, MAX_CELLS, Se2};

/// How far off, in cells, the corners of a map may be and it still lies on the lattice; far below
/// the half cell at which nearest-cell mapping would differ from a copy.
const ON_LATTICE: f64 = 1e-3;

/// Beyond this many cells from the lattice's origin, cells are no longer whole numbers.
const FARTHEST: f64 = 4_503_599_627_370_496.0;

/// The lattice of the output, in the reference frame with yaw 0: through the origin of the first
/// map where that one's yaw is 0 there, else through the origin of the reference frame, so that it
/// does not depend on how far the maps reach.
pub(crate) fn output_lattice(
    first: &GridFrame,
    size: (usize, usize),
    reference_from_map: &Se2,
    resolution: Option<f64>,
) -> Result<GridFrame, GridError> {
    let reference_from_grid = *reference_from_map * first.map_from_grid();
    let extent = size.0.max(size.1) as f64;
    let reference_from_lattice = if reference_from_grid.theta().abs() * extent <= ON_LATTICE {
        Se2::new(reference_from_grid.x(), reference_from_grid.y(), 0.0)
    } else {
        Se2::identity()
    };
    let resolution = resolution.unwrap_or(first.resolution());
    GridFrame::new(resolution, reference_from_lattice)
}

/// A rectangle of lattice cells: whole numbers, from inclusive, to exclusive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Footprint {
    from: [f64; 2],
    to: [f64; 2],
    /// Whether the map's cells are cells of the lattice.
    pub(crate) whole_cells: bool,
}

impl Footprint {
    /// The lattice cells that a grid of `size` in `frame` reaches; with `with_far_edge` also those
    /// that begin where it ends.
    pub(crate) fn new(
        lattice: &GridFrame,
        frame: &GridFrame,
        size: (usize, usize),
        reference_from_map: &Se2,
        with_far_edge: bool,
    ) -> Result<Self, GridError> {
        let (width, height) = (size.0 as f64, size.1 as f64);
        let corner_cells = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
        let corners = corner_cells.map(|(column, row)| {
            let point = frame.point_from_cells(Point2::new(column, row));
            lattice.cells_from_point(*reference_from_map * point)
        });
        if !corners.iter().all(|c| c.x.abs() < FARTHEST && c.y.abs() < FARTHEST) {
            return Err(GridError::TooLarge {
                width: usize::MAX,
                height: usize::MAX,
                limit: MAX_CELLS,
            });
        }
        let shift = corners[0].map(f64::round);
        let whole_cells = corners.iter().zip(corner_cells).all(|(corner, (column, row))| {
            let off = corner - shift - Point2::new(column, row).coords;
            off.x.abs() <= ON_LATTICE && off.y.abs() <= ON_LATTICE
        });
        if whole_cells {
            return Ok(Self {
                from: [shift.x, shift.y],
                to: [shift.x + width, shift.y + height],
                whole_cells,
            });
        }
        let [first, others @ ..] = &corners;
        let low = others.iter().fold(*first, |low, corner| low.inf(corner));
        let high = others.iter().fold(*first, |high, corner| high.sup(corner));
        let far_edge = if with_far_edge { 1.0 } else { 0.0 };
        Ok(Self {
            from: [low.x, low.y].map(|low| (low + ON_LATTICE).floor()),
            to: [high.x, high.y].map(|high| (high - ON_LATTICE).ceil() + far_edge),
            whole_cells,
        })
    }

    /// A grid of `size` from cell (0, 0) of the lattice.
    pub(crate) fn of_grid(size: (usize, usize)) -> Self {
        Self { from: [0.0; 2], to: [size.0 as f64, size.1 as f64], whole_cells: true }
    }

    /// The smallest rectangle that holds both.
    pub(crate) fn union(self, other: &Self) -> Self {
        Self {
            from: [0, 1].map(|axis| self.from[axis].min(other.from[axis])),
            to: [0, 1].map(|axis| self.to[axis].max(other.to[axis])),
            whole_cells: false,
        }
    }

    /// The part of it inside `outer`, or `None`.
    pub(crate) fn clipped(self, outer: &Self) -> Option<Self> {
        let from = [0, 1].map(|axis| self.from[axis].max(outer.from[axis]));
        let to = [0, 1].map(|axis| self.to[axis].min(outer.to[axis]));
        let whole_cells = self.whole_cells && from == self.from && to == self.to;
        (from[0] < to[0] && from[1] < to[1]).then_some(Self { from, to, whole_cells })
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> (usize, usize) {
        (to_count(self.to[0] - self.from[0]), to_count(self.to[1] - self.from[1]))
    }

    /// Column and row of its first cell, counted from the first cell of `outer`, which holds it.
    pub(crate) fn offset_in(&self, outer: &Self) -> (usize, usize) {
        (to_count(self.from[0] - outer.from[0]), to_count(self.from[1] - outer.from[1]))
    }

    /// The frame of its first cell.
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2⁵², checked in new")]
    pub(crate) fn frame(&self, lattice: &GridFrame) -> GridFrame {
        lattice.shifted(self.from[0] as i64, self.from[1] as i64)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number, not negative by construction and below 2⁵⁴"
)]
fn to_count(x: f64) -> usize {
    x as usize
}

#[cfg(test)]
mod tests {
    use super::{Footprint, output_lattice};
    use ogm_core::{GridError, GridFrame, Se2};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use std::f64::consts::PI;

    fn frame(x: f64, y: f64, yaw: f64) -> GridFrame {
        GridFrame::new(0.05, Se2::new(x, y, yaw)).unwrap()
    }

    proptest! {
        #[test]
        fn whole_cell_moves_stay_on_the_lattice(
            x in -50.0_f64..50.0, y in -50.0_f64..50.0, column in -900_i32..900, row in -900_i32..900,
        ) {
            let lattice = frame(x, y, 0.0);
            let reference_from_map = Se2::new(0.05 * f64::from(column), 0.05 * f64::from(row), 0.0);
            let footprint = Footprint::new(&lattice, &lattice, (300, 200), &reference_from_map, false).unwrap();
            prop_assert!(footprint.whole_cells);
            prop_assert_eq!(footprint.from, [f64::from(column), f64::from(row)]);
            prop_assert_eq!(footprint.size(), (300, 200));
        }

        #[test]
        fn a_map_without_yaw_in_the_reference_frame_keeps_its_cells(
            x in -50.0_f64..50.0, y in -50.0_f64..50.0, yaw in -PI..PI,
        ) {
            let first = frame(1.03, -2.01, yaw);
            let reference_from_map = Se2::new(x, y, 0.0) * Se2::new(0.0, 0.0, -yaw);
            let lattice = output_lattice(&first, (300, 200), &reference_from_map, None).unwrap();
            prop_assert_eq!(lattice.map_from_grid().theta(), 0.0);
            let footprint = Footprint::new(&lattice, &first, (300, 200), &reference_from_map, false).unwrap();
            prop_assert!(footprint.whole_cells);
            prop_assert_eq!(footprint.from, [0.0, 0.0]);
        }
    }

    #[test]
    fn a_map_half_a_cell_off_or_turned_is_not_on_the_lattice() {
        let lattice = frame(0.0, 0.0, 0.0);
        for reference_from_map in [Se2::new(0.025, 0.0, 0.0), Se2::new(0.0, 0.0, 1e-4)] {
            let footprint =
                Footprint::new(&lattice, &lattice, (300, 200), &reference_from_map, false);
            assert!(!footprint.unwrap().whole_cells);
        }
    }

    #[test]
    fn a_map_beyond_any_whole_number_of_cells_is_an_error() {
        let lattice = frame(0.0, 0.0, 0.0);
        for x in [1e15, 1e300, f64::MAX] {
            let far = Footprint::new(&lattice, &lattice, (3, 2), &Se2::new(x, 0.0, 0.0), false);
            assert!(matches!(far, Err(GridError::TooLarge { .. })), "{x}");
        }
    }
}
