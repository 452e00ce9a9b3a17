//! Cells of one grid on the lattice of another.

use std::borrow::Cow;

use nalgebra::{Point2, Vector2};
use ogm_core::{Grid, GridError, GridFrame, NearestWarp, Progress, Se2, Steps};

use crate::error::FusionError;
use crate::gaps::fill_holes;
use crate::lattice::Footprint;
use crate::params::{ForwardRounding, GapTreatment, Mapping};

/// Keeps rounding errors of whole-cell moves from deciding between two cells.
const NUDGE: f64 = 1e-9;

/// Cells in their place on the output.
pub(crate) struct Layer<'a, T: Clone> {
    pub(crate) column: usize,
    pub(crate) row: usize,
    pub(crate) cells: Cow<'a, Grid<T>>,
}

impl<T: Clone> Layer<'_, T> {
    /// Its cells in output row `row`, from column [`column`](Self::column); `None` above and below.
    pub(crate) fn output_row(&self, row: usize) -> Option<&[T]> {
        let row = row.checked_sub(self.row)?;
        (row < self.cells.height()).then(|| self.cells.row(row))
    }
}

/// Cells, and where they lie in the reference frame.
pub(crate) struct Source<'a, T: Clone> {
    pub(crate) cells: Cow<'a, Grid<T>>,
    pub(crate) frame: GridFrame,
    pub(crate) reference_from_map: Se2,
}

/// What a cell holds where nothing lands, and what a hole among cells takes from those around it.
pub(crate) struct Vacant<T, F: Fn(&[T]) -> T> {
    pub(crate) value: T,
    pub(crate) fill: F,
}

impl<'a, T: Copy + PartialEq> Source<'a, T> {
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.cells.width(), self.cells.height())
    }

    pub(crate) fn footprint(
        &self,
        lattice: &GridFrame,
        mapping: &Mapping,
    ) -> Result<Footprint, GridError> {
        let corners_land =
            matches!(mapping, Mapping::Forward { rounding: ForwardRounding::FloorOfInteger, .. });
        let pose = &self.reference_from_map;
        Footprint::new(lattice, &self.frame, self.size(), pose, corners_land)
    }

    /// The cells on the lattice cells of `footprint`; any interpolation is nearest cell.
    pub(crate) fn onto(
        self,
        lattice: &GridFrame,
        footprint: &Footprint,
        mapping: &Mapping,
        vacant: Vacant<T, impl Fn(&[T]) -> T>,
        progress: &dyn Progress,
    ) -> Result<Cow<'a, Grid<T>>, FusionError> {
        if footprint.whole_cells {
            return Ok(self.cells);
        }
        let target_frame = footprint.frame(lattice);
        let size = footprint.size();
        let mapped = match mapping {
            Mapping::Inverse(_) => {
                let warp = NearestWarp::new(&self.frame, &target_frame, &self.reference_from_map)?;
                let mut mapped = Grid::filled(size.0, size.1, vacant.value)?;
                let done = Steps::new(progress, size.1);
                for (row, output) in mapped.cells_mut().chunks_exact_mut(size.0).enumerate() {
                    warp.fill_row(&self.cells, row, output);
                    done.step()?;
                }
                mapped
            }
            Mapping::Forward { rounding, gaps } => {
                let mapped =
                    self.scattered(&target_frame, size, *rounding, vacant.value, progress)?;
                match gaps {
                    GapTreatment::HoleFill => fill_holes(&mapped, vacant.value, vacant.fill),
                    _ => mapped,
                }
            }
        };
        Ok(Cow::Owned(mapped))
    }

    /// Every present cell written where it lands (Tsardoulias et al., Eq. 15).
    fn scattered(
        &self,
        target_frame: &GridFrame,
        size: (usize, usize),
        rounding: ForwardRounding,
        absent: T,
        progress: &dyn Progress,
    ) -> Result<Grid<T>, FusionError> {
        let (width, height) = size;
        let mut target = Grid::filled(width, height, absent)?;
        let target_cells = CellMap::new(&self.frame, target_frame, &self.reference_from_map);
        let corner = match rounding {
            ForwardRounding::Centre => 0.5,
            ForwardRounding::FloorOfInteger => 0.0,
        };
        let done = Steps::new(progress, self.cells.height());
        for (row, cells) in self.cells.rows().enumerate() {
            done.step()?;
            let start = target_cells.at(corner, row as f64 + corner);
            for (column, &cell) in cells.iter().enumerate() {
                if cell == absent {
                    continue;
                }
                let landed = start + target_cells.column_step * column as f64;
                let inside = cell_below(landed.x, width).zip(cell_below(landed.y, height));
                if let Some((to_column, to_row)) = inside {
                    target.cells_mut()[to_row * width + to_column] = cell;
                }
            }
        }
        Ok(target)
    }
}

/// The cell that contains the coordinate `x`, if it is one of `count`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be in 0..count before the cast"
)]
pub(crate) fn cell_below(x: f64, count: usize) -> Option<usize> {
    let cell = (x + NUDGE).floor();
    (cell >= 0.0 && cell < count as f64).then_some(cell as usize)
}

/// Continuous cell coordinates of one frame as an affine function of another's.
pub(crate) struct CellMap {
    origin: Point2<f64>,
    /// Change a column.
    pub(crate) column_step: Vector2<f64>,
    row_step: Vector2<f64>,
}

impl CellMap {
    pub(crate) fn new(source: &GridFrame, target: &GridFrame, target_from_source: &Se2) -> Self {
        let map = |column, row| {
            let point = source.point_from_cells(Point2::new(column, row));
            target.cells_from_point(*target_from_source * point)
        };
        // A long baseline keeps rounding of large coordinates out of the steps.
        let baseline = 65_536.0;
        let origin = map(0.0, 0.0);
        Self {
            origin,
            column_step: (map(baseline, 0.0) - origin) / baseline,
            row_step: (map(0.0, baseline) - origin) / baseline,
        }
    }

    pub(crate) fn at(&self, column: f64, row: f64) -> Point2<f64> {
        self.origin + self.column_step * column + self.row_step * row
    }
}
