//! Connected pieces of a grid.

use ogm_core::{CellIndex, Grid};

/// Cells of one kind that touch each other by side or corner.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// Positions in the grid.
    pub(crate) cells: Vec<usize>,
    /// Whether it reaches the rim of the grid.
    pub(crate) is_open: bool,
    low: CellIndex,
    high: CellIndex,
}

impl Piece {
    /// Of its bounding box, cells.
    pub(crate) fn longer_side(&self) -> f64 {
        let (low, high) = (self.low, self.high);
        ((high.column - low.column).max(high.row - low.row) + 1) as f64
    }
}

/// The pieces of the cells for which `belongs` holds, in the order of their first cells.
pub(crate) fn pieces<T>(grid: &Grid<T>, belongs: impl Fn(&T) -> bool) -> Vec<Piece> {
    let mut left: Vec<bool> = grid.cells().iter().map(belongs).collect();
    let mut found = Vec::new();
    for start in 0..left.len() {
        if left[start] {
            found.push(flood(grid, &mut left, start));
        }
    }
    found
}

fn flood<T>(grid: &Grid<T>, left: &mut [bool], start: usize) -> Piece {
    let (width, height) = (grid.width(), grid.height());
    let first = grid.index_of(start);
    let mut piece = Piece { cells: Vec::new(), is_open: false, low: first, high: first };
    left[start] = false;
    let mut open = vec![start];
    while let Some(at) = open.pop() {
        let CellIndex { column, row } = grid.index_of(at);
        piece.cells.push(at);
        piece.is_open |= column == 0 || row == 0 || column + 1 == width || row + 1 == height;
        piece.low.column = piece.low.column.min(column);
        piece.low.row = piece.low.row.min(row);
        piece.high.column = piece.high.column.max(column);
        piece.high.row = piece.high.row.max(row);
        for near_row in row.saturating_sub(1)..=(row + 1).min(height - 1) {
            for near_column in column.saturating_sub(1)..=(column + 1).min(width - 1) {
                let near = near_row * width + near_column;
                if std::mem::take(&mut left[near]) {
                    open.push(near);
                }
            }
        }
    }
    piece
}

#[cfg(test)]
mod tests {
    use super::pieces;
    use ogm_core::Grid;

    #[test]
    fn corners_connect_and_the_rim_opens() {
        let picture = "#....#...\n..##.....\n...#.#...\n....#....\n.........";
        let cells = picture.lines().flat_map(str::chars).collect();
        let grid = Grid::new(9, 5, cells).unwrap();
        let found = pieces(&grid, |&cell| cell == '#');
        let sizes: Vec<_> = found.iter().map(|piece| (piece.cells.len(), piece.is_open)).collect();
        assert_eq!(sizes, [(1, true), (1, true), (5, false)]);
        assert_eq!(found[2].longer_side(), 4.0);
    }
}
