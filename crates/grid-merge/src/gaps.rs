//! Gaps of forward mapping: filled, blurred, or left as the paper's printed condition leaves them.

use ogm_core::{ClassThresholds, Grid, Occupancy};

/// Known neighbours of eight that a hole must have: more than half.
const NEIGHBOURS_NEEDED: u8 = 5;

/// The byte of p = ½, which is what Eq. 16 takes an unexplored cell for.
const HALF: u8 = 127;

/// `cells` with every `absent` cell that has at least five present neighbours set to `fill` of
/// them, all read from `cells` itself.
pub(crate) fn fill_holes<T: Copy + PartialEq>(
    cells: &Grid<T>,
    absent: T,
    fill: impl Fn(&[T]) -> T,
) -> Grid<T> {
    let (width, height) = (cells.width(), cells.height());
    let mut filled = cells.clone();
    let mut present_in_column = vec![0_u8; width];
    let mut present = Vec::with_capacity(8);
    for (row, output) in filled.cells_mut().chunks_exact_mut(width).enumerate() {
        let rows = row.saturating_sub(1)..(row + 2).min(height);
        present_in_column.fill(0);
        for near in rows.clone() {
            for (count, &cell) in present_in_column.iter_mut().zip(cells.row(near)) {
                *count += u8::from(cell != absent);
            }
        }
        for (column, cell) in output.iter_mut().enumerate() {
            if *cell != absent {
                continue;
            }
            let columns = column.saturating_sub(1)..(column + 2).min(width);
            let count: u8 = present_in_column[columns.clone()].iter().sum();
            if count >= NEIGHBOURS_NEEDED {
                let near = rows.clone().flat_map(|near| &cells.row(near)[columns.clone()]);
                present.clear();
                present.extend(near.filter(|&&neighbour| neighbour != absent));
                *cell = fill(&present);
            }
        }
    }
    filled
}

/// The value of a hole: the mean of the free neighbours if they are the majority, else of all.
pub(crate) fn mean_of_majority(known: &[Occupancy], thresholds: &ClassThresholds) -> Occupancy {
    let is_free = |cell: &&Occupancy| thresholds.is_free(**cell);
    if 2 * known.iter().filter(is_free).count() > known.len() {
        mean(known.iter().filter(is_free))
    } else {
        mean(known.iter())
    }
}

fn mean<'a>(cells: impl Iterator<Item = &'a Occupancy>) -> Occupancy {
    let (sum, count) = cells
        .filter_map(|cell| cell.probability())
        .fold((0.0, 0_u32), |(sum, count), p| (sum + p, count + 1));
    // No cell gives NaN, which is unknown.
    Occupancy::from_probability(sum / f64::from(count))
}

/// Tsardoulias et al., Eq. 16, on every cell: unknown only where nothing near is known.
pub(crate) fn blur_everywhere(cells: &Grid<Occupancy>) -> Grid<Occupancy> {
    let near_known = mean_3x3(&cells.map(|cell| if cell.is_known() { 254 } else { 0 }));
    let mut blurred = mean_of_explored(cells);
    for (cell, &near_known) in blurred.cells_mut().iter_mut().zip(near_known.cells()) {
        if near_known == 0 {
            *cell = Occupancy::UNKNOWN;
        }
    }
    blurred
}

/// Eq. 16 under the printed condition: only cells that are explored and free are replaced.
pub(crate) fn blur_free(cells: &Grid<Occupancy>, thresholds: &ClassThresholds) -> Grid<Occupancy> {
    let mut blurred = mean_of_explored(cells);
    for (cell, &before) in blurred.cells_mut().iter_mut().zip(cells.cells()) {
        if !thresholds.is_free(before) {
            *cell = before;
        }
    }
    blurred
}

/// Eq. 16 on a coverage field: covered where at least half of the 3 × 3 cells are.
pub(crate) fn blur_coverage(covered: &Grid<bool>) -> Grid<bool> {
    mean_3x3(&covered.map(|&covered| if covered { 254 } else { 0 })).map(|&mean| mean >= HALF)
}

fn mean_of_explored(cells: &Grid<Occupancy>) -> Grid<Occupancy> {
    let values = cells.map(|cell| if cell.is_known() { cell.byte() } else { HALF });
    mean_3x3(&values).map(|&byte| Occupancy::from_byte(byte))
}

/// The mean of each cell and its neighbours, divided by how many of the nine exist.
#[expect(clippy::cast_possible_truncation, reason = "a mean of bytes is a byte")]
fn mean_3x3(values: &Grid<u8>) -> Grid<u8> {
    let (width, height) = (values.width(), values.height());
    let mut means = values.clone();
    let mut column_sums = vec![0_u16; width];
    for (row, output) in means.cells_mut().chunks_exact_mut(width).enumerate() {
        let rows = row.saturating_sub(1)..(row + 2).min(height);
        column_sums.fill(0);
        for near in rows.clone() {
            for (sum, &value) in column_sums.iter_mut().zip(values.row(near)) {
                *sum += u16::from(value);
            }
        }
        for (column, mean) in output.iter_mut().enumerate() {
            let columns = column.saturating_sub(1)..(column + 2).min(width);
            let count = (rows.len() * columns.len()) as u16;
            let sum: u16 = column_sums[columns].iter().sum();
            *mean = ((sum + count / 2) / count) as u8;
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::{blur_coverage, blur_everywhere, blur_free, fill_holes, mean_of_majority};
    use ogm_core::{ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};

    fn picture(cells: Grid<Occupancy>) -> String {
        let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
        OccupancyGrid::new(frame, cells).to_ascii()
    }

    fn map(picture: &str) -> Grid<Occupancy> {
        let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap().cells().clone()
    }

    fn filled(cells: &Grid<Occupancy>) -> Grid<Occupancy> {
        let thresholds = ClassThresholds::default();
        fill_holes(cells, Occupancy::UNKNOWN, |known| mean_of_majority(known, &thresholds))
    }

    #[test]
    fn a_hole_takes_the_side_of_its_majority() {
        let free_side = filled(&map("####\n.?..\n...."));
        assert_eq!(picture(free_side), "####\n....\n....\n");
        let wall_side = filled(&map("####\n#?##\n#..."));
        assert_eq!(picture(wall_side), "####\n####\n#...\n");
    }

    #[test]
    fn four_known_neighbours_are_no_hole() {
        let cells = map("...\n.??\n???");
        assert_eq!(filled(&cells), cells);
    }

    #[test]
    fn the_mean_at_the_border_is_over_the_cells_that_exist() {
        let corner = |first: u8| {
            let mut cells = map("..\n..");
            cells.cells_mut()[0] = Occupancy::from_byte(first);
            blur_everywhere(&cells).cells()[0].byte()
        };
        assert_eq!(corner(25), 25);
        assert_eq!(corner(225), 75);
    }

    #[test]
    fn the_printed_condition_changes_free_cells_only() {
        let cells = map("###\n...\n.?.\n...");
        let blurred = blur_free(&cells, &ClassThresholds::default());
        for (&before, &after) in cells.cells().iter().zip(blurred.cells()) {
            let free = before == Occupancy::FREE;
            assert_eq!(free, before != after, "{before:?} became {after:?}");
        }
    }

    #[test]
    fn blurred_coverage_closes_a_gap_and_drops_a_speck() {
        let covered = |picture: &str| map(picture).map(|&cell| cell == Occupancy::FREE);
        assert_eq!(blur_coverage(&covered("...\n.?.\n...")), covered("...\n...\n..."));
        assert_eq!(blur_coverage(&covered("???\n?.?\n???")), covered("???\n???\n???"));
    }
}
