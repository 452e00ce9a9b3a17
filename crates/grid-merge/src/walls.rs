//! The walls of a fused map while it is being made.

use std::ops::Range;

use nalgebra::Point2;
use ogm_core::Occupancy;

use crate::mapping::cell_below;
use crate::rows::WarpedReach;

/// Cells of the merged map within which a wall of an input must have a wall: it may lie on the
/// other side of a cell's border, and no further.
pub(crate) const NEAR_CELLS: f64 = 1.5;

/// The walls of the fused map in some rows of the output.
pub(crate) struct Walls {
    rows: Range<usize>,
    width: usize,
    /// One more than the place in the order of the map that put the wall there; 0 is no wall.
    put_by: Vec<u16>,
}

impl Walls {
    pub(crate) fn none() -> Self {
        Self { rows: 0..0, width: 0, put_by: Vec::new() }
    }

    /// Makes it `rows` of an output of `width` columns without a wall.
    pub(crate) fn clear(&mut self, rows: Range<usize>, width: usize) {
        self.put_by.clear();
        self.put_by.resize(rows.len() * width, 0);
        (self.rows, self.width) = (rows, width);
    }

    /// Whether a wall of the map `by` is beside the cell.
    pub(crate) fn is_beside(&self, row: usize, column: usize, by: u16) -> bool {
        let (row, column) = (row.cast_signed(), column.cast_signed());
        AROUND.iter().any(|&[right, up]| self.at(row + up, column + right) == by)
    }

    /// Of each column, one more than the place in the order of the map that put a wall there.
    pub(crate) fn row(&self, row: usize) -> &[u16] {
        &self.put_by[(row - self.rows.start) * self.width..][..self.width]
    }

    fn at(&self, row: isize, column: isize) -> u16 {
        let row = usize::try_from(row).ok().filter(|row| self.rows.contains(row));
        let column = usize::try_from(column).ok();
        row.zip(column).and_then(|(row, column)| self.row(row).get(column)).copied().unwrap_or(0)
    }

    /// Whether one of the cells `around` has the wall of a map before `by`: `Some(false)` if the
    /// cell itself has.
    pub(crate) fn surer_wall_among(
        &self,
        around: &[[isize; 2]],
        row: usize,
        column: usize,
        by: u16,
    ) -> Option<bool> {
        if by == 1 {
            return None;
        }
        let (row, column) = (row.cast_signed(), column.cast_signed());
        let is_surer = |&&[right, up]: &&[isize; 2]| {
            let near = self.at(row + up, column + right);
            near > 0 && near < by
        };
        around.iter().find(is_surer).map(|&offset| offset != [0, 0])
    }

    /// The wall cells of a map that have no wall near the place where they land: no centre of an
    /// output cell fell on them, or what was the same wall is too far off.
    pub(crate) fn missing(&self, reach: &WarpedReach<'_>) -> Vec<(usize, usize, Occupancy)> {
        let mut missing = Vec::new();
        let below = self.rows.start as f64;
        reach.for_each_wall(&self.rows, |cell, place| {
            let row = cell_below(place.y - below, self.rows.len());
            let Some((row, column)) = row.zip(cell_below(place.x, self.width)) else { return };
            let row = row + self.rows.start;
            let is_near = |&[right, up]: &[isize; 2]| {
                let (column, row) = (column.cast_signed() + right, row.cast_signed() + up);
                let centre = Point2::new(column as f64 + 0.5, row as f64 + 0.5);
                self.at(row, column) > 0 && (centre - place).norm() <= NEAR_CELLS
            };
            if !WITHIN_TWO.iter().any(is_near) {
                missing.push((row, column, cell));
            }
        });
        missing
    }

    pub(crate) fn put(&mut self, row: usize, column: usize, by: u16) {
        self.put_by[(row - self.rows.start) * self.width + column] = by;
    }
}

/// Columns and rows to the cells beside one.
const AROUND: [[isize; 2]; 8] =
    [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

/// Columns and rows to where a wall within [`NEAR_CELLS`] can be, the likeliest first.
const WITHIN_TWO: [[isize; 2]; 21] = [
    [0, 0],
    [-1, 0],
    [1, 0],
    [0, -1],
    [0, 1],
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
    [-2, 0],
    [2, 0],
    [0, -2],
    [0, 2],
    [-2, -1],
    [-2, 1],
    [2, -1],
    [2, 1],
    [-1, -2],
    [1, -2],
    [-1, 2],
    [1, 2],
];
