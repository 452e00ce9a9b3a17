//! A rectangle of cells.

use crate::error::GridError;

/// The most cells that a grid may have: 2²⁹, a square of 23 170 a side.
pub const MAX_CELLS: usize = 1 << 29;

/// A cell by column (x) and row (y); row 0 is the lowest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CellIndex {
    /// Cells to the right of column 0.
    pub column: usize,
    /// Cells above row 0.
    pub row: usize,
}

/// Cells of a rectangle in one allocation, row-major, row 0 lowest; never empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid<T> {
    width: usize,
    cells: Vec<T>,
}

impl<T> Grid<T> {
    /// A grid over `cells`, row-major from the lowest row.
    ///
    /// # Errors
    /// Zero area, more than [`MAX_CELLS`], or a length that is not `width * height`.
    pub fn new(width: usize, height: usize, cells: Vec<T>) -> Result<Self, GridError> {
        if cells.len() != cell_count(width, height)? {
            return Err(GridError::WrongCellCount { width, height, cells: cells.len() });
        }
        Ok(Self { width, cells })
    }

    /// A grid with every cell equal to `value`.
    ///
    /// # Errors
    /// Zero area or more than [`MAX_CELLS`]; nothing is allocated then.
    pub fn filled(width: usize, height: usize, value: T) -> Result<Self, GridError>
    where
        T: Clone,
    {
        Ok(Self { width, cells: vec![value; cell_count(width, height)?] })
    }

    /// Columns, at least 1.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows, at least 1.
    #[must_use]
    pub fn height(&self) -> usize {
        self.cells.len() / self.width
    }

    /// All cells, row-major from the lowest row.
    #[must_use]
    pub fn cells(&self) -> &[T] {
        &self.cells
    }

    /// All cells, row-major from the lowest row.
    #[must_use]
    pub fn cells_mut(&mut self) -> &mut [T] {
        &mut self.cells
    }

    /// All cells, row-major from the lowest row.
    #[must_use]
    pub fn into_cells(self) -> Vec<T> {
        self.cells
    }

    /// The cells of one row.
    ///
    /// # Panics
    /// If `row` is not below [`height`](Self::height).
    #[must_use]
    pub fn row(&self, row: usize) -> &[T] {
        &self.cells[row * self.width..][..self.width]
    }

    /// Rows from the lowest up.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[T]> + ExactSizeIterator {
        self.cells.chunks_exact(self.width)
    }

    /// The cell at `index`, or `None` outside.
    #[must_use]
    pub fn get(&self, index: CellIndex) -> Option<&T> {
        self.position(index).map(|position| &self.cells[position])
    }

    /// The cell at `index`, or `None` outside.
    #[must_use]
    pub fn get_mut(&mut self, index: CellIndex) -> Option<&mut T> {
        self.position(index).map(|position| &mut self.cells[position])
    }

    fn position(&self, index: CellIndex) -> Option<usize> {
        let inside = index.column < self.width && index.row < self.height();
        inside.then(|| index.row * self.width + index.column)
    }

    /// The column and row of the cell at `position` in [`cells`](Self::cells).
    #[must_use]
    pub fn index_of(&self, position: usize) -> CellIndex {
        CellIndex { column: position % self.width, row: position / self.width }
    }

    /// A grid of the same size with `f` of every cell.
    #[must_use]
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Grid<U> {
        Grid { width: self.width, cells: self.cells.iter().map(f).collect() }
    }

    /// The lowest and highest column and row, both inclusive, of the cells that `counts` picks.
    #[must_use]
    pub fn bounds_of(&self, counts: impl Fn(&T) -> bool) -> Option<(CellIndex, CellIndex)> {
        let mut bounds: Option<(CellIndex, CellIndex)> = None;
        for (row, cells) in self.rows().enumerate() {
            let Some(first) = cells.iter().position(&counts) else { continue };
            let last = cells.iter().rposition(&counts).unwrap_or(first);
            let (low, high) = bounds.map_or((first, last), |(low, high)| {
                (low.column.min(first), high.column.max(last))
            });
            let lowest = bounds.map_or(row, |(low, _)| low.row);
            bounds =
                Some((CellIndex { column: low, row: lowest }, CellIndex { column: high, row }));
        }
        bounds
    }

    /// Every cell with its index, row-major from the lowest row.
    pub fn indexed(&self) -> impl Iterator<Item = (CellIndex, &T)> {
        self.rows().enumerate().flat_map(|(row, cells)| {
            cells.iter().enumerate().map(move |(column, cell)| (CellIndex { column, row }, cell))
        })
    }
}

/// The cells of a grid of `width` × `height`, for who reads them before there is a grid.
///
/// # Errors
/// Zero area or more than [`MAX_CELLS`].
pub fn cell_count(width: usize, height: usize) -> Result<usize, GridError> {
    if width == 0 || height == 0 {
        return Err(GridError::ZeroArea { width, height });
    }
    match width.checked_mul(height) {
        Some(count) if count <= MAX_CELLS => Ok(count),
        _ => Err(GridError::TooLarge { width, height, limit: MAX_CELLS }),
    }
}

#[cfg(test)]
mod tests {
    use super::{CellIndex, Grid};
    use crate::GridError;

    #[test]
    fn absurd_sizes_are_errors_before_they_are_allocations() {
        let billion = 1_000_000_000;
        assert!(matches!(Grid::filled(billion, billion, 0_u8), Err(GridError::TooLarge { .. })));
        assert!(matches!(Grid::filled(usize::MAX, 2, 0_u8), Err(GridError::TooLarge { .. })));
        assert!(matches!(Grid::filled(0, 7, 0_u8), Err(GridError::ZeroArea { .. })));
        assert!(matches!(Grid::new(2, 2, vec![1_u8]), Err(GridError::WrongCellCount { .. })));
    }

    #[test]
    fn bounds_hold_every_cell_that_counts_and_touch_one_on_each_side() {
        let cells = [0, 0, 0, 0, 0, 0, 7, 0, 0, 7, 0, 0, 0, 0, 0];
        let grid = Grid::new(5, 3, cells.to_vec()).unwrap();
        let corner = |column, row| CellIndex { column, row };
        assert_eq!(grid.bounds_of(|&cell| cell == 7), Some((corner(1, 1), corner(4, 1))));
        assert_eq!(grid.bounds_of(|&cell| cell == 0), Some((corner(0, 0), corner(4, 2))));
        assert_eq!(grid.bounds_of(|&cell| cell == 1), None);
    }

    #[test]
    fn a_column_beyond_the_width_is_outside_and_not_the_next_row() {
        let grid = Grid::new(2, 2, vec![0, 1, 2, 3]).unwrap();
        assert_eq!(grid.get(CellIndex { column: 2, row: 0 }), None);
        assert_eq!(grid.get(CellIndex { column: 0, row: 2 }), None);
        assert_eq!(grid.get(CellIndex { column: 1, row: usize::MAX / 2 + 1 }), None);
        assert_eq!(grid.get(CellIndex { column: 1, row: 1 }), Some(&3));
    }
}
