//! What of a map is compared: the cells of the two classes, cropped to where there are any.

use ogm_core::{CellClass, Grid};

/// C of the paper, −255 and 255.
pub(crate) const CLASSES: usize = 2;

/// A cell of neither class.
pub(crate) const NEITHER: u8 = 0;

/// Codes of a map's cells: [`NEITHER`], or 1 plus the index of the class.
#[derive(Debug, Clone)]
pub(crate) struct ClassMap {
    /// Cropped; one cell of neither class where there is nothing.
    pub(crate) codes: Grid<u8>,
    /// Column and row of the crop's first cell in the map.
    pub(crate) first: [i64; 2],
    /// Columns and rows of the whole map.
    pub(crate) size: [usize; 2],
    /// Cells of each class: obstacles, then free.
    pub(crate) counts: [usize; CLASSES],
}

impl ClassMap {
    pub(crate) fn new(cells: &Grid<CellClass>) -> Self {
        let codes = cells.map(|class| match class {
            CellClass::Occupied => 1,
            CellClass::Free => 2,
            CellClass::Undecided | CellClass::Unknown => NEITHER,
        });
        let count = |code| codes.cells().iter().filter(|&&cell| cell == code).count();
        let counts = [count(1), count(2)];
        let size = [codes.width(), codes.height()];
        // One cell if there is none of either class.
        let (low, high) =
            codes.bounds_of(|&code| code != NEITHER).map_or(([0, 0], [1, 1]), |(low, high)| {
                ([low.column, low.row], [high.column + 1, high.row + 1])
            });
        let rows = codes.rows().skip(low[1]).take(high[1] - low[1]);
        let cropped = rows.flat_map(|row| &row[low[0]..high[0]]).copied().collect();
        let cropped = Grid::new(high[0] - low[0], high[1] - low[1], cropped).unwrap_or(codes);
        Self {
            codes: cropped,
            first: low.map(usize::cast_signed).map(|at| at as i64),
            size,
            counts,
        }
    }

    /// Cells of either class.
    pub(crate) fn known(&self) -> usize {
        self.counts.iter().sum()
    }

    /// The middle of the whole map in cells of its lattice: the reference point R(m).
    pub(crate) fn centre(&self) -> [f64; 2] {
        self.size.map(|side| side as f64 / 2.0)
    }
}
