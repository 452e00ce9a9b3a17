//! The wall of a map that is nearest to a point.

use nalgebra::Point2;

use crate::{CellIndex, ClassThresholds, GridFrame, NearestCells, OccupancyGrid};

/// The walls of a map, looked up by points anywhere.
///
/// ```
/// use nalgebra::Point2;
/// use ogm_core::{ClassThresholds, GridFrame, NearestWall, OccupancyGrid, Se2};
///
/// let frame = GridFrame::new(1.0, Se2::identity())?;
/// let map = OccupancyGrid::from_ascii(frame, "#...\n....")?;
/// let walls = NearestWall::new(&map, &ClassThresholds::default()).expect("it has a wall");
/// assert_eq!(walls.nearest_to(Point2::new(3.2, 0.1)), Point2::new(0.5, 1.5));
/// # Ok::<(), ogm_core::GridError>(())
/// ```
#[derive(Debug, Clone)]
pub struct NearestWall {
    frame: GridFrame,
    size: [usize; 2],
    nearest: NearestCells,
}

impl NearestWall {
    /// The walls of `map`, or `None` if it has no occupied cell.
    #[must_use]
    pub fn new(map: &OccupancyGrid, thresholds: &ClassThresholds) -> Option<Self> {
        let nearest = NearestCells::new(&map.occupied_mask(thresholds))?;
        Some(Self { frame: *map.frame(), size: [map.width(), map.height()], nearest })
    }

    /// Centre of the occupied cell nearest to the cell of `point`, both in the map's frame, metres;
    /// for a point outside the grid, of the one nearest to the closest cell of the border, which
    /// may not be the nearest to the point itself.
    #[must_use]
    pub fn nearest_to(&self, point: Point2<f64>) -> Point2<f64> {
        let at = self.frame.lattice_cell(point);
        let [column, row] = [0, 1].map(|axis| {
            usize::try_from(at[axis].max(0)).unwrap_or(usize::MAX).min(self.size[axis] - 1)
        });
        self.frame.cell_centre(self.nearest.at(CellIndex { column, row }))
    }
}
