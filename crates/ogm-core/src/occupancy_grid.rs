//! A map: what is known about each cell, and where the cells lie.

use nalgebra::Point2;

use crate::{CellIndex, ClassThresholds, Grid, GridError, GridFrame, Occupancy};

/// A map: occupancy cells and where they lie.
#[derive(Debug, Clone, PartialEq)]
pub struct OccupancyGrid {
    frame: GridFrame,
    cells: Grid<Occupancy>,
}

impl OccupancyGrid {
    /// The map of `cells` in `frame`.
    #[must_use]
    pub fn new(frame: GridFrame, cells: Grid<Occupancy>) -> Self {
        Self { frame, cells }
    }

    /// Where the cells lie.
    #[must_use]
    pub fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// The cells, row 0 lowest.
    #[must_use]
    pub fn cells(&self) -> &Grid<Occupancy> {
        &self.cells
    }

    /// The cells, row 0 lowest.
    #[must_use]
    pub fn cells_mut(&mut self) -> &mut Grid<Occupancy> {
        &mut self.cells
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.cells.width()
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.cells.height()
    }

    /// That `other` has cells of the same size, for kernels that compare cell by cell.
    ///
    /// # Errors
    /// [`GridError::ResolutionMismatch`].
    pub fn check_same_resolution(&self, other: &Self) -> Result<(), GridError> {
        if self.frame.same_resolution(&other.frame) {
            return Ok(());
        }
        Err(GridError::ResolutionMismatch {
            a_width: self.width(),
            a_height: self.height(),
            a_resolution: self.frame.resolution(),
            b_width: other.width(),
            b_height: other.height(),
            b_resolution: other.frame.resolution(),
        })
    }

    /// The cell that contains the map point `point`, or `None` outside.
    #[must_use]
    pub fn cell_at(&self, point: Point2<f64>) -> Option<CellIndex> {
        let [column, row] = self.frame.lattice_cell(point);
        let index =
            CellIndex { column: usize::try_from(column).ok()?, row: usize::try_from(row).ok()? };
        self.cells.get(index).map(|_| index)
    }

    /// Occupancy at the map point `point`; outside the grid everything is unknown.
    #[must_use]
    pub fn at(&self, point: Point2<f64>) -> Occupancy {
        self.cell_at(point)
            .and_then(|index| self.cells.get(index))
            .copied()
            .unwrap_or(Occupancy::UNKNOWN)
    }

    /// Occupied cells as a mask.
    #[must_use]
    pub fn occupied_mask(&self, thresholds: &ClassThresholds) -> Grid<bool> {
        self.cells.map(|&cell| thresholds.is_occupied(cell))
    }

    /// Centres of the occupied cells in the map frame, metres, row-major.
    #[must_use]
    pub fn occupied_points(&self, thresholds: &ClassThresholds) -> Vec<Point2<f64>> {
        self.cells
            .indexed()
            .filter(|&(_, &cell)| thresholds.is_occupied(cell))
            .map(|(index, _)| self.frame.cell_centre(index))
            .collect()
    }
}
