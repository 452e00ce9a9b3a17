//! The nearest set cell, exactly, for every cell of a grid.

use std::ops::Range;

use crate::{CellIndex, Grid};

/// For every cell of a mask, its nearest set cell in the Euclidean sense.
///
/// A feature transform in time linear in the cells, with the lower-envelope scan of Meijster,
/// Roerdink and Hesselink (2000), all in integers. Equal distances go to the same cell each time.
#[derive(Debug, Clone)]
pub struct NearestCells {
    /// Column and row of the nearest set cell.
    nearest: Grid<[u32; 2]>,
}

fn to_index([column, row]: [u32; 2]) -> CellIndex {
    CellIndex { column: column as usize, row: row as usize }
}

/// No set cell in this column.
const NONE: u32 = u32::MAX;

impl NearestCells {
    /// The nearest set cells of `mask`, or `None` if no cell is set.
    #[must_use]
    pub fn new(mask: &Grid<bool>) -> Option<Self> {
        if !mask.cells().contains(&true) {
            return None;
        }
        let row_of_nearest = nearest_in_column(mask);
        let width = mask.width();
        let mut nearest = mask.map(|_| [0, 0]);
        let mut envelope = Envelope::with_capacity(width);
        for (row, output) in nearest.cells_mut().chunks_exact_mut(width).enumerate() {
            envelope.rebuild(row_of_nearest.row(row), row);
            envelope.write_nearest(output);
        }
        Some(Self { nearest })
    }

    /// The set cell nearest to `index`, or `None` outside the grid.
    #[must_use]
    pub fn nearest(&self, index: CellIndex) -> Option<CellIndex> {
        self.nearest.get(index).map(|&cell| to_index(cell))
    }

    /// [`nearest`](Self::nearest) inside the grid.
    pub(crate) fn at(&self, index: CellIndex) -> CellIndex {
        to_index(self.nearest.row(index.row)[index.column])
    }
}

/// Squared Euclidean distance, in cells², from every cell to the nearest set cell of `mask`;
/// exact up to 65 535 cells, where it saturates. `None` if no cell is set.
///
/// As [`NearestCells`], in a third of its memory.
#[must_use]
pub fn l2_distance_sq(mask: &Grid<bool>) -> Option<Grid<u32>> {
    if !mask.cells().contains(&true) {
        return None;
    }
    // Each row becomes the distances once its parabolas are known.
    let mut distance = nearest_in_column(mask);
    let width = mask.width();
    let mut envelope = Envelope::with_capacity(width);
    for (row, cells) in distance.cells_mut().chunks_exact_mut(width).enumerate() {
        envelope.rebuild(cells, row);
        envelope.write_distance_sq(cells);
    }
    Some(distance)
}

/// For every cell the row of the nearest set cell in its own column, the lower one on a tie.
#[expect(clippy::cast_possible_truncation, reason = "a grid has fewer than 2³² rows")]
fn nearest_in_column(mask: &Grid<bool>) -> Grid<u32> {
    let (width, height) = (mask.width(), mask.height());
    let mut nearest = mask.map(|_| NONE);
    let cells = nearest.cells_mut();
    let mut last_seen = vec![NONE; width];
    for row in 0..height {
        let output = &mut cells[row * width..][..width];
        for ((cell, seen), &set) in output.iter_mut().zip(&mut last_seen).zip(mask.row(row)) {
            if set {
                *seen = row as u32;
            }
            *cell = *seen;
        }
    }
    last_seen.fill(NONE);
    for row in (0..height).rev() {
        let row_u32 = row as u32;
        let output = &mut cells[row * width..][..width];
        for (cell, seen) in output.iter_mut().zip(&mut last_seen) {
            if *cell == row_u32 {
                *seen = row_u32;
            } else if *seen != NONE && (*cell == NONE || *seen - row_u32 < row_u32 - *cell) {
                *cell = *seen;
            }
        }
    }
    nearest
}

/// The lower envelope of the parabolas (x − column)² + height of one row.
struct Envelope {
    parabolas: Vec<Parabola>,
}

#[derive(Clone, Copy)]
struct Parabola {
    column: i64,
    nearest_row: u32,
    height: i64,
    /// First column where this parabola is the lowest.
    from: i64,
}

impl Parabola {
    fn at(&self, x: i64) -> i64 {
        (x - self.column) * (x - self.column) + self.height
    }

    /// Last column where this parabola is not above `right`, which starts further right.
    fn last_before(&self, right: &Self) -> i64 {
        let apart = right.column - self.column;
        let rise = right.height - self.height + apart * (right.column + self.column);
        // Most parabolas have their neighbour in the next column, and a division costs the most.
        if apart == 1 { rise >> 1 } else { rise.div_euclid(2 * apart) }
    }
}

impl Envelope {
    fn with_capacity(width: usize) -> Self {
        Self { parabolas: Vec::with_capacity(width) }
    }

    fn rebuild(&mut self, row_of_nearest: &[u32], row: usize) {
        self.parabolas.clear();
        for (column, &nearest_row) in (0_i64..).zip(row_of_nearest) {
            if nearest_row == NONE {
                continue;
            }
            let rise = i64::from(nearest_row) - row as i64;
            let mut next = Parabola { column, nearest_row, height: rise * rise, from: 0 };
            while self.parabolas.last().is_some_and(|last| last.at(last.from) > next.at(last.from))
            {
                self.parabolas.pop();
            }
            if let Some(last) = self.parabolas.last() {
                next.from = last.last_before(&next) + 1;
                if next.from >= row_of_nearest.len() as i64 {
                    continue;
                }
            }
            self.parabolas.push(next);
        }
    }

    /// Columns and rows of the parabolas that are lowest.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "columns of a grid are non-negative and below 2³²"
    )]
    fn write_nearest(&self, output: &mut [[u32; 2]]) {
        for (parabola, columns) in self.pieces(output.len()) {
            output[columns].fill([parabola.column as u32, parabola.nearest_row]);
        }
    }

    /// Their values.
    fn write_distance_sq(&self, output: &mut [u32]) {
        for (parabola, columns) in self.pieces(output.len()) {
            for (column, cell) in (parabola.from..).zip(&mut output[columns]) {
                *cell = u32::try_from(parabola.at(column)).unwrap_or(u32::MAX);
            }
        }
    }

    /// The parabolas of a row of `width` cells, each with the columns where it is the lowest.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "columns of a grid are non-negative and below 2³²"
    )]
    fn pieces(&self, width: usize) -> impl Iterator<Item = (&Parabola, Range<usize>)> {
        let ends = self.parabolas.iter().skip(1).map(|next| next.from as usize).chain([width]);
        self.parabolas
            .iter()
            .zip(ends)
            .map(|(parabola, end)| (parabola, parabola.from as usize..end))
    }
}

#[cfg(test)]
mod tests {
    use super::{NearestCells, l2_distance_sq};
    use crate::{CellIndex, Grid};
    use proptest::prelude::{any, prop, prop_assert, prop_assert_eq, proptest};

    fn squared(a: CellIndex, b: CellIndex) -> usize {
        a.column.abs_diff(b.column).pow(2) + a.row.abs_diff(b.row).pow(2)
    }

    #[test]
    fn an_empty_mask_has_no_nearest_cell() {
        assert!(l2_distance_sq(&Grid::filled(4, 3, false).unwrap()).is_none());
    }

    #[test]
    fn one_cell_is_nearest_to_all() {
        let mut mask = Grid::filled(7, 3, false).unwrap();
        let seed = CellIndex { column: 5, row: 1 };
        *mask.get_mut(seed).unwrap() = true;
        let nearest = NearestCells::new(&mask).unwrap();
        assert!(mask.indexed().all(|(index, _)| nearest.nearest(index) == Some(seed)));
    }

    proptest! {
        #[test]
        fn equals_brute_force(
            width in 1_usize..16, height in 1_usize..16, density in 0.01_f64..0.6,
            noise in prop::collection::vec(0.0_f64..1.0, 16 * 16), seed in any::<prop::sample::Index>(),
        ) {
            let bits = noise[..width * height].iter().map(|&u| u < density).collect();
            let mut mask = Grid::new(width, height, bits).unwrap();
            let one = seed.index(width * height);
            mask.cells_mut()[one] = true;
            let transform = NearestCells::new(&mask).unwrap();
            let distance = l2_distance_sq(&mask).unwrap();
            for (cell, &d) in distance.indexed() {
                let brute = mask.indexed().filter(|(_, set)| **set)
                    .map(|(other, _)| squared(cell, other)).min().unwrap();
                let nearest = transform.nearest(cell).unwrap();
                prop_assert_eq!(d as usize, brute);
                prop_assert_eq!(squared(cell, nearest), brute);
                prop_assert!(mask.get(nearest) == Some(&true));
            }
        }
    }
}
