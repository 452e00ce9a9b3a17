//! City-block distance to the nearest set cell.

use crate::Grid;

/// City-block distance, in cells, from every cell to the nearest set cell of `mask`.
///
/// The two raster passes of Carpin and Birk (*Stochastic map merging*, Algorithm 2), taken apart by
/// axis; what lies outside the grid is infinitely far and infinity plus one stays infinity. `None`
/// if no cell is set.
#[must_use]
pub fn l1_distance(mask: &Grid<bool>) -> Option<Grid<u32>> {
    if !mask.cells().contains(&true) {
        return None;
    }
    let mut distance = mask.map(|&set| if set { 0 } else { u32::MAX });
    l1_spread(&mut distance);
    Some(distance)
}

/// Lowers every cell to the least, over all cells, of that cell's value plus the city-block
/// distance to it, in cells; `u32::MAX` is infinity.
///
/// [`l1_distance`] in place, from values other than zero.
pub fn l1_spread(values: &mut Grid<u32>) {
    let (width, height) = (values.width(), values.height());
    let cells = values.cells_mut();
    for row in cells.chunks_exact_mut(width) {
        relax_along_row(row);
    }
    for row in 1..height {
        let (below, current) = cells[(row - 1) * width..(row + 1) * width].split_at_mut(width);
        relax_from_neighbour(current, below);
    }
    for row in (0..height - 1).rev() {
        let (current, above) = cells[row * width..(row + 2) * width].split_at_mut(width);
        relax_from_neighbour(current, above);
    }
}

/// Shortens distances by one step from the adjacent row.
fn relax_from_neighbour(row: &mut [u32], neighbour: &[u32]) {
    for (cell, &near) in row.iter_mut().zip(neighbour) {
        *cell = (*cell).min(near.saturating_add(1));
    }
}

/// Shortens distances by steps along the row, in both directions.
fn relax_along_row(row: &mut [u32]) {
    let mut reach = u32::MAX;
    for cell in row.iter_mut() {
        reach = reach.saturating_add(1).min(*cell);
        *cell = reach;
    }
    let mut reach = u32::MAX;
    for cell in row.iter_mut().rev() {
        reach = reach.saturating_add(1).min(*cell);
        *cell = reach;
    }
}

#[cfg(test)]
mod tests {
    use super::l1_distance;
    use crate::{CellIndex, Grid};
    use proptest::prelude::{any, prop, prop_assert_eq, proptest};

    #[test]
    fn worked_example_of_two_seeds() {
        let mut mask = Grid::filled(5, 5, false).unwrap();
        for (column, row) in [(1, 1), (4, 3)] {
            *mask.get_mut(CellIndex { column, row }).unwrap() = true;
        }
        let expected =
            [[2, 1, 2, 3, 3], [1, 0, 1, 2, 2], [2, 1, 2, 2, 1], [3, 2, 2, 1, 0], [4, 3, 3, 2, 1]];
        assert_eq!(l1_distance(&mask).unwrap().cells(), expected.as_flattened());
    }

    #[test]
    fn an_empty_mask_has_no_nearest_cell() {
        assert_eq!(l1_distance(&Grid::filled(3, 2, false).unwrap()), None);
    }

    proptest! {
        #[test]
        fn equals_brute_force(
            width in 1_usize..14, height in 1_usize..14,
            bits in prop::collection::vec(prop::bool::weighted(0.1), 14 * 14), seed in any::<prop::sample::Index>(),
        ) {
            let mut mask = Grid::new(width, height, bits[..width * height].to_vec()).unwrap();
            let one = seed.index(width * height);
            mask.cells_mut()[one] = true;
            let distance = l1_distance(&mask).unwrap();
            for (cell, &d) in distance.indexed() {
                let brute = mask.indexed().filter(|(_, set)| **set).map(|(other, _)| {
                    cell.column.abs_diff(other.column) + cell.row.abs_diff(other.row)
                }).min().unwrap();
                prop_assert_eq!(d as usize, brute);
            }
        }
    }
}
