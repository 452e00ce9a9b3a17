//! A set of cells, one bit each.

use ogm_core::{CellIndex, Grid};

/// A set of cells of a grid, one bit each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellMask {
    width: usize,
    height: usize,
    bits: Vec<u64>,
}

impl CellMask {
    pub(crate) fn empty((width, height): (usize, usize)) -> Self {
        Self { width, height, bits: vec![0; (width * height).div_ceil(64)] }
    }

    pub(crate) fn insert(&mut self, row: usize, column: usize) {
        let at = row * self.width + column;
        self.bits[at / 64] |= 1 << (at % 64);
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Whether the cell is in the set; no cell outside is.
    #[must_use]
    pub fn contains(&self, index: CellIndex) -> bool {
        let at = index.row * self.width + index.column;
        index.column < self.width
            && index.row < self.height
            && self.bits[at / 64] >> (at % 64) & 1 == 1
    }

    /// How many cells are in it.
    #[must_use]
    pub fn count(&self) -> usize {
        self.bits.iter().map(|bits| bits.count_ones() as usize).sum()
    }

    /// The cells in it, row-major from the lowest row.
    pub fn iter(&self) -> impl Iterator<Item = CellIndex> {
        let cells = self.bits.iter().enumerate().filter(|&(_, &bits)| bits != 0).flat_map(
            |(word, &bits)| {
                (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| 64 * word + bit)
            },
        );
        cells.map(|at| CellIndex { column: at % self.width, row: at / self.width })
    }

    /// As a grid of one byte a cell.
    ///
    /// # Panics
    /// Never: it has the size of a grid.
    #[must_use]
    pub fn to_grid(&self) -> Grid<bool> {
        let mut grid = Grid::filled(self.width, self.height, false).expect("the size of a grid");
        for index in self.iter() {
            if let Some(cell) = grid.get_mut(index) {
                *cell = true;
            }
        }
        grid
    }
}
