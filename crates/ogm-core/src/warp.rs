//! A grid seen through a transform.

use std::ops::Range;

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
    let warp = NearestWarp::new(source_frame, target_frame, target_from_source)?;
    let (width, height) = target_size;
    let mut target = Grid::filled(width, height, outside)?;
    for (row, output) in target.cells_mut().chunks_exact_mut(width).enumerate() {
        warp.fill_row(source, row, output);
    }
    Ok(target)
}

/// [`warp_nearest`] row by row, for callers that do more on the way.
#[derive(Debug, Clone, Copy)]
pub struct NearestWarp {
    /// Source cell coordinates of the centre of target cell (0, 0).
    origin: Point2<f64>,
    /// Their change a target column.
    step: Vector2<f64>,
    /// Their change a target row.
    row_step: Vector2<f64>,
}

impl NearestWarp {
    /// From the lattice of `source_frame` onto that of `target_frame`.
    ///
    /// # Errors
    /// A non-finite transform.
    pub fn new(
        source_frame: &GridFrame,
        target_frame: &GridFrame,
        target_from_source: &Se2,
    ) -> Result<Self, GridError> {
        target_from_source.check_finite()?;
        let source_from_target = target_from_source.inverse();
        let source_cells = |column: f64, row: f64| {
            let point = target_frame.point_from_cells(Point2::new(column, row));
            source_frame.cells_from_point(source_from_target * point)
        };
        let origin = source_cells(0.5, 0.5);
        // A long baseline keeps rounding of large coordinates out of the step.
        let baseline = 65_536.0;
        Ok(Self {
            origin,
            step: (source_cells(0.5 + baseline, 0.5) - origin) / baseline,
            row_step: (source_cells(0.5, 0.5 + baseline) - origin) / baseline,
        })
    }

    /// Sets the cells of target row `row`, `output` from column 0, that `source` covers; leaves
    /// the others.
    pub fn fill_row<T: Copy>(&self, source: &Grid<T>, row: usize, output: &mut [T]) {
        if !self.is_finite() {
            // So far away that cells are lost in rounding: nothing of the source is here.
            return;
        }
        let start = self.origin + self.row_step * row as f64;
        let along = 0..i64::try_from(output.len()).unwrap_or(i64::MAX);
        let cells = CellsOnLine::new(start, self.step, along, (source.width(), source.height()));
        let first = usize::try_from(cells.first()).unwrap_or(0);
        for (cell, position) in output[first..].iter_mut().zip(cells) {
            if let Some(position) = position {
                *cell = source.cells()[position];
            }
        }
    }

    fn is_finite(&self) -> bool {
        let numbers = self.origin.coords.iter().chain(&self.step).chain(&self.row_step);
        numbers.fold(0.0, |sum, x| sum + x).is_finite()
    }
}

/// The cells of a grid that equally spaced points of a line fall on.
///
/// Two integer additions a point instead of two `floor` calls: coordinates have 32 fractional
/// bits. An item is the position in the grid's cells, or `None` where the point lies outside; the
/// first belongs to column [`first`](Self::first), the next to the column after.
#[derive(Debug, Clone)]
pub struct CellsOnLine {
    columns: Range<i64>,
    at: [i64; 2],
    step: [i64; 2],
    width: u64,
    height: u64,
}

impl CellsOnLine {
    /// For columns `along`, whose points lie at `start + column * step` in cells of a grid of
    /// `size` (columns and rows): those that can fall on it, and at most one more at each end.
    #[must_use]
    pub fn new(
        start: Point2<f64>,
        step: Vector2<f64>,
        along: Range<i64>,
        size: (usize, usize),
    ) -> Self {
        let columns = columns_inside(start, step, along, size);
        let first = columns.start as f64;
        Self {
            columns,
            at: [start.x + step.x * first, start.y + step.y * first].map(to_fixed),
            step: [step.x, step.y].map(to_fixed),
            width: size.0 as u64,
            height: size.1 as u64,
        }
    }

    /// The column of the next item.
    #[must_use]
    pub fn first(&self) -> i64 {
        self.columns.start
    }
}

impl Iterator for CellsOnLine {
    type Item = Option<usize>;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a position in the grid")]
    fn next(&mut self) -> Option<Option<usize>> {
        self.columns.next()?;
        // A negative coordinate is a large one without its sign.
        let [column, row] = self.at.map(|at| (at >> 32).cast_unsigned());
        // The range was found in floating point, so its ends may be one cell off.
        let inside = column < self.width && row < self.height;
        self.at = [0, 1].map(|axis| self.at[axis].wrapping_add(self.step[axis]));
        Some(inside.then(|| (row * self.width + column) as usize))
    }
}

fn columns_inside(
    start: Point2<f64>,
    step: Vector2<f64>,
    along: Range<i64>,
    size: (usize, usize),
) -> Range<i64> {
    let (low, high) = (along.start, along.end);
    let (mut from, mut to) = (low as f64, high as f64);
    for (start, step, extent) in
        [(start.x, step.x, size.0 as f64), (start.y, step.y, size.1 as f64)]
    {
        if step.abs() < 1e-12 {
            if start < -1.0 || start > extent + 1.0 {
                return low..low;
            }
        } else {
            let (a, b) = (-start / step, (extent - start) / step);
            from = from.max(a.min(b).floor() - 1.0);
            to = to.min(a.max(b).ceil() + 1.0);
        }
    }
    let (from, to) = (clamped(from, low, high), clamped(to, low, high));
    from..to.max(from)
}

#[expect(clippy::cast_possible_truncation, reason = "clamped to the columns after it saturates")]
fn clamped(column: f64, low: i64, high: i64) -> i64 {
    (column as i64).clamp(low, high)
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
