//! Where the cells of a grid lie.

use std::ops::RangeInclusive;

use nalgebra::Point2;

use crate::{CellIndex, GridError, Se2};

/// Where the cells of a grid lie in its map frame.
///
/// ```text
///        y (grid)
///        │  ┌────┬────┬────┐
///        │  │0,1 │1,1 │2,1 │   cell (column, row) covers [column, column+1) × [row, row+1)
///        │  ├────┼────┼────┤   in cells; its centre is (column + ½, row + ½)
///        │  │0,0 │1,0 │2,0 │
///        │  └────┴────┴────┘
///        └──●──────────────── x (grid)
///   map_from_grid: pose of ● in the map frame, metres and radians
/// ```
///
/// Only this type converts between cells and metres. Two frames are the same lattice when
/// [`same_resolution`](Self::same_resolution) holds and their origins differ by whole cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridFrame {
    resolution: f64,
    map_from_grid: Se2,
}

impl GridFrame {
    /// Accepted metres a cell: 0.1 mm to 1 km.
    ///
    /// Below, nothing is a map of a building, and kernels whose size is given in metres become
    /// unbounded numbers of cells; above, a cell is larger than any building.
    pub const RESOLUTIONS: RangeInclusive<f64> = 1e-4..=1e3;

    /// Largest accepted |x| and |y| of an origin, metres: 10 000 km.
    ///
    /// A quarter of the earth's circumference, so that origins in metres of a UTM zone fit; an
    /// `f64` still keeps nanometres there.
    pub const MAX_ORIGIN: f64 = 1e7;

    /// A frame of `resolution` metres a cell, `map_from_grid` being the pose of the lower-left
    /// corner of cell (0, 0).
    ///
    /// # Errors
    /// A resolution outside [`RESOLUTIONS`](Self::RESOLUTIONS), an origin beyond
    /// [`MAX_ORIGIN`](Self::MAX_ORIGIN), or a yaw that is not finite.
    pub fn new(resolution: f64, map_from_grid: Se2) -> Result<Self, GridError> {
        if !Self::RESOLUTIONS.contains(&resolution) {
            let (least, most) = (*Self::RESOLUTIONS.start(), *Self::RESOLUTIONS.end());
            return Err(GridError::Resolution { resolution, least, most });
        }
        let (x, y, limit) = (map_from_grid.x(), map_from_grid.y(), Self::MAX_ORIGIN);
        if !(x.abs() <= limit && y.abs() <= limit) {
            return Err(GridError::Origin { x, y, limit });
        }
        map_from_grid.check_finite()?;
        Ok(Self { resolution, map_from_grid })
    }

    /// Metres a cell.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The pose of the lower-left corner of cell (0, 0) in the map frame.
    #[must_use]
    pub fn map_from_grid(&self) -> Se2 {
        self.map_from_grid
    }

    /// The centre of a cell in the map frame, metres.
    #[must_use]
    pub fn cell_centre(&self, index: CellIndex) -> Point2<f64> {
        self.point_from_cells(Point2::new(index.column as f64 + 0.5, index.row as f64 + 0.5))
    }

    /// The map point at the continuous cell coordinates `cells`.
    #[must_use]
    pub fn point_from_cells(&self, cells: Point2<f64>) -> Point2<f64> {
        self.map_from_grid * (cells * self.resolution)
    }

    /// The continuous cell coordinates of the map point `point`; may lie outside any grid.
    #[must_use]
    pub fn cells_from_point(&self, point: Point2<f64>) -> Point2<f64> {
        (self.map_from_grid.inverse() * point) / self.resolution
    }

    /// Column and row of the lattice cell that contains `point`; may lie outside any grid.
    ///
    /// Saturates at the limits of `i64`.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "saturation is documented")]
    pub fn lattice_cell(&self, point: Point2<f64>) -> [i64; 2] {
        let cells = self.cells_from_point(point);
        [cells.x.floor() as i64, cells.y.floor() as i64]
    }

    /// The frame of the same lattice whose cell (0, 0) is this one's cell (`column`, `row`).
    ///
    /// Of a lattice near the accepted limit it may lie beyond it.
    #[must_use]
    pub fn shifted(&self, column: i64, row: i64) -> Self {
        let corner = Point2::new(column as f64, row as f64) * self.resolution;
        let shift = Se2::new(corner.x, corner.y, 0.0);
        Self { resolution: self.resolution, map_from_grid: self.map_from_grid * shift }
    }

    /// Whether the resolutions agree to a relative 1e-6, the precision of a ROS message.
    #[must_use]
    pub fn same_resolution(&self, other: &Self) -> bool {
        (self.resolution / other.resolution - 1.0).abs() <= 1e-6
    }
}

#[cfg(test)]
mod tests {
    use super::GridFrame;
    use crate::{CellIndex, GridError, Se2};
    use nalgebra::Point2;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use std::f64::consts::PI;

    proptest! {
        #[test]
        fn cells_and_metres_round_trip_under_any_origin(
            x in -1e3_f64..1e3, y in -1e3_f64..1e3, yaw in -PI..PI,
            resolution in 0.005_f64..1.0, column in 0_usize..5000, row in 0_usize..5000,
        ) {
            let frame = GridFrame::new(resolution, Se2::new(x, y, yaw)).unwrap();
            let centre = frame.cell_centre(CellIndex { column, row });
            prop_assert_eq!(frame.lattice_cell(centre), [column as i64, row as i64]);
            let cells = frame.cells_from_point(centre);
            prop_assert!((cells - Point2::new(column as f64 + 0.5, row as f64 + 0.5)).norm() < 1e-6);
        }

        #[test]
        fn a_shifted_frame_names_the_same_places(
            yaw in -PI..PI, column in -50_i64..50, row in -50_i64..50,
        ) {
            let frame = GridFrame::new(0.05, Se2::new(2.0, -1.0, yaw)).unwrap();
            let shifted = frame.shifted(column, row);
            let here = shifted.point_from_cells(Point2::new(3.0, 4.0));
            let there = frame.point_from_cells(Point2::new(3.0 + column as f64, 4.0 + row as f64));
            prop_assert!((here - there).norm() < 1e-9);
        }
    }

    #[test]
    fn frames_that_cannot_be_meant_are_errors() {
        for resolution in [0.0, -0.05, f64::NAN, f64::INFINITY, 0.99e-4, 1001.0, 1e300, 1e-9] {
            let frame = GridFrame::new(resolution, Se2::identity());
            assert!(matches!(frame, Err(GridError::Resolution { .. })), "{resolution}");
        }
        for far in [f64::NAN, f64::NEG_INFINITY, 1.01e7, -1e25] {
            for origin in [Se2::new(far, 0.0, 0.0), Se2::new(0.0, far, 0.0)] {
                let frame = GridFrame::new(0.05, origin);
                assert!(matches!(frame, Err(GridError::Origin { .. })), "{far}");
            }
        }
        let frame = GridFrame::new(0.05, Se2::new(0.0, 0.0, f64::NAN));
        assert!(matches!(frame, Err(GridError::NonFiniteTransform { .. })));
    }

    #[test]
    fn the_accepted_ranges_hold_their_ends_and_errors_name_value_and_range() {
        for resolution in [1e-4, 1e3] {
            GridFrame::new(resolution, Se2::new(1e7, -1e7, 1.0)).unwrap();
        }
        let error = GridFrame::new(1e300, Se2::identity()).unwrap_err().to_string();
        assert!(error.contains("1e300") && error.contains("0.0001 to 1000 m"), "{error}");
        let error = GridFrame::new(0.05, Se2::new(2e7, 0.0, 0.0)).unwrap_err().to_string();
        assert!(error.contains("(20000000.0, 0.0)") && error.contains("10000000 m"), "{error}");
    }

    #[test]
    fn a_resolution_that_went_through_a_ros_message_is_the_same() {
        let exact = GridFrame::new(0.05, Se2::identity()).unwrap();
        let message = GridFrame::new(f64::from(0.05_f32), Se2::identity()).unwrap();
        assert!(exact.same_resolution(&message));
        assert!(!exact.same_resolution(&GridFrame::new(0.0501, Se2::identity()).unwrap()));
    }
}
