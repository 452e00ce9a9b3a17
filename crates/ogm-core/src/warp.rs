//! A grid seen through a transform.

use nalgebra::{Point2, Vector2};

use crate::{Grid, GridError, GridFrame, Se2};

/// `source` resampled onto a target lattice by nearest cell: for each target cell centre the
/// source cell that contains it, `outside` where there is none.
///
/// Inverse mapping, so the result has no gaps. The two frames may differ in resolution and yaw.
/// `target_size` is columns and rows.
///
/// # Errors
/// A non-finite transform, or a target size of zero area or over the limit.
pub fn warp_nearest<T: Copy>(
    source: &Grid<T>,
    source_frame: &GridFrame,
    target_frame: &GridFrame,
    target_size: (usize, usize),
    target_from_source: &Se2,
    outside: T,
) -> Result<Grid<T>, GridError> {
    let motion = target_from_source;
    if !motion.is_finite() {
        return Err(GridError::NonFiniteTransform {
            x: motion.x(),
            y: motion.y(),
            theta: motion.theta(),
        });
    }
    let (width, height) = target_size;
    let mut target = Grid::filled(width, height, outside)?;
    let walk = CellWalk::new(source_frame, target_frame, motion);
    if !walk.is_finite() {
        // So far away that cells are lost in rounding: nothing of the source is here.
        return Ok(target);
    }
    let (columns, rows) = (source.width(), source.height());
    for (row, output) in target.cells_mut().chunks_exact_mut(width).enumerate() {
        let start = walk.row_start(row);
        let (from, to) = walk.columns_inside(start, width, columns, rows);
        let mut at = [
            FixedPoint::at(start.x, walk.step.x, from),
            FixedPoint::at(start.y, walk.step.y, from),
        ];
        for cell in &mut output[from..to] {
            let (column, row) = (at[0].floor(), at[1].floor());
            // The range above is found in floating point, so its ends may be one cell off.
            let inside = usize::try_from(column).ok().zip(usize::try_from(row).ok());
            if let Some((column, row)) =
                inside.filter(|&(column, row)| column < columns && row < rows)
            {
                *cell = source.cells()[row * columns + column];
            }
            at[0].advance();
            at[1].advance();
        }
    }
    Ok(target)
}

/// Source cell coordinates as an affine function of target cells.
struct CellWalk {
    origin: Point2<f64>,
    /// Change a target column.
    step: Vector2<f64>,
    /// Change a target row.
    row_step: Vector2<f64>,
}

impl CellWalk {
    fn new(source_frame: &GridFrame, target_frame: &GridFrame, target_from_source: &Se2) -> Self {
        let source_from_target = target_from_source.inverse();
        let source_cells = |column: f64, row: f64| {
            let point = target_frame.point_from_cells(Point2::new(column, row));
            source_frame.cells_from_point(source_from_target * point)
        };
        let origin = source_cells(0.5, 0.5);
        // A long baseline keeps rounding of large coordinates out of the step.
        let baseline = 65_536.0;
        Self {
            origin,
            step: (source_cells(0.5 + baseline, 0.5) - origin) / baseline,
            row_step: (source_cells(0.5, 0.5 + baseline) - origin) / baseline,
        }
    }

    fn is_finite(&self) -> bool {
        let numbers = self.origin.coords.iter().chain(&self.step).chain(&self.row_step);
        numbers.fold(0.0, |sum, x| sum + x).is_finite()
    }

    fn row_start(&self, row: usize) -> Point2<f64> {
        self.origin + self.row_step * row as f64
    }

    /// The range of target columns that can fall on the source, at most one too many at each end.
    fn columns_inside(
        &self,
        start: Point2<f64>,
        width: usize,
        columns: usize,
        rows: usize,
    ) -> (usize, usize) {
        let mut from = 0.0_f64;
        let mut to = width as f64;
        for (start, step, extent) in
            [(start.x, self.step.x, columns as f64), (start.y, self.step.y, rows as f64)]
        {
            if step.abs() < 1e-12 {
                if start < -1.0 || start > extent + 1.0 {
                    return (0, 0);
                }
            } else {
                let (a, b) = (-start / step, (extent - start) / step);
                from = from.max(a.min(b).floor() - 1.0);
                to = to.min(a.max(b).ceil() + 1.0);
            }
        }
        if from < to { (to_column(from), to_column(to)) } else { (0, 0) }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a column of the target before"
)]
fn to_column(x: f64) -> usize {
    x.max(0.0) as usize
}

/// A coordinate with 32 fractional bits: two integer additions a cell instead of a `floor` call.
struct FixedPoint {
    value: i64,
    step: i64,
}

impl FixedPoint {
    fn at(start: f64, step: f64, column: usize) -> Self {
        Self { value: to_fixed(start + step * column as f64), step: to_fixed(step) }
    }

    fn floor(&self) -> i64 {
        self.value >> 32
    }

    fn advance(&mut self) {
        self.value = self.value.wrapping_add(self.step);
    }
}

#[expect(clippy::cast_possible_truncation, reason = "saturates; far outside any source grid")]
fn to_fixed(x: f64) -> i64 {
    (x * 4_294_967_296.0).round() as i64
}

#[cfg(test)]
mod tests {
    use super::warp_nearest;
    use crate::{CellIndex, Grid, GridError, GridFrame, Se2};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use std::f64::consts::PI;

    fn numbered(width: usize, height: usize) -> Grid<isize> {
        Grid::new(width, height, (0..).take(width * height).collect()).unwrap()
    }

    proptest! {
        #[test]
        fn every_cell_is_the_one_that_contains_its_centre(
            x in -2.0_f64..2.0, y in -2.0_f64..2.0, theta in -PI..PI,
            source_yaw in -PI..PI, source_resolution in 0.03_f64..0.2,
        ) {
            let source = numbered(23, 17);
            let source_frame = GridFrame::new(source_resolution, Se2::new(0.3, -0.4, source_yaw)).unwrap();
            let target_frame = GridFrame::new(0.07, Se2::new(-1.5, -1.0, 0.4)).unwrap();
            let target_from_source = Se2::new(x, y, theta);
            let warped = warp_nearest(&source, &source_frame, &target_frame, (41, 37), &target_from_source, -1).unwrap();
            for (index, &value) in warped.indexed() {
                let point = target_from_source.inverse() * target_frame.cell_centre(index);
                let cells = source_frame.cells_from_point(point);
                let at_border = (cells.x - cells.x.round()).abs() < 1e-6 || (cells.y - cells.y.round()).abs() < 1e-6;
                let [column, row] = source_frame.lattice_cell(point);
                let expected = usize::try_from(column).ok().zip(usize::try_from(row).ok())
                    .and_then(|(column, row)| source.get(CellIndex { column, row })).copied().unwrap_or(-1);
                prop_assert!(at_border || value == expected, "{index:?}: {value} instead of {expected}");
            }
        }

        #[test]
        fn whole_cells_copy(shift_x in -5_isize..5, shift_y in -5_isize..5) {
            let source = numbered(8, 6);
            let frame = GridFrame::new(0.05, Se2::new(12.3, -45.6, 0.0)).unwrap();
            let target_from_source = Se2::new(0.05 * shift_x as f64, 0.05 * shift_y as f64, 0.0);
            let warped = warp_nearest(&source, &frame, &frame, (8, 6), &target_from_source, -1).unwrap();
            for (index, &value) in warped.indexed() {
                let column = index.column.cast_signed() - shift_x;
                let row = index.row.cast_signed() - shift_y;
                let inside = (0..8).contains(&column) && (0..6).contains(&row);
                prop_assert_eq!(value, if inside { row * 8 + column } else { -1 });
            }
        }
    }

    #[test]
    fn a_source_beyond_all_reach_is_outside() {
        let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
        for x in [1e12, f64::MAX] {
            let target_from_source = Se2::new(x, 0.0, 0.3);
            let warped =
                warp_nearest(&numbered(2, 2), &frame, &frame, (3, 3), &target_from_source, -1);
            assert!(warped.unwrap().cells().iter().all(|&cell| cell == -1), "{x}");
        }
    }

    #[test]
    fn a_transform_that_is_not_finite_is_an_error() {
        let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
        let target_from_source = Se2::new(f64::NAN, 0.0, 0.0);
        let warped = warp_nearest(&numbered(2, 2), &frame, &frame, (2, 2), &target_from_source, -1);
        assert!(matches!(warped, Err(GridError::NonFiniteTransform { .. })));
    }
}
