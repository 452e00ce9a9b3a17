//! How much of a segment lies on occupied cells.

use ogm_core::{CellIndex, Grid, Occupancy};

use crate::strip::{Cell, difference};

/// Mean probability of the cells under the rasterised segment between `limits`, each the highest
/// within `band` cells across it; unknown counts one half.
///
/// Tsardoulias et al. take the mean "of all line elements"; the cells that voted for the line are
/// occupied by construction, those under it are not.
pub(crate) fn reliability(grid: &Grid<Occupancy>, limits: [Cell; 2], band: u16) -> f64 {
    let [from, to] = limits;
    let [x, y] = difference(to, from);
    let steps = x.abs().max(y.abs()).max(1);
    let across = if x.abs() >= y.abs() { [0, 1] } else { [1, 0] };
    let band = i64::from(band);
    let mut sum = 0.0;
    for step in 0..=steps {
        let column = i64::from(from[0]) + rounded_share(step, x, steps);
        let row = i64::from(from[1]) + rounded_share(step, y, steps);
        let highest = (-band..=band)
            .filter_map(|offset| {
                probability(grid, column + offset * across[0], row + offset * across[1])
            })
            .fold(0.0, f64::max);
        sum += highest;
    }
    sum / (steps + 1) as f64
}

/// `step` · `extent` / `steps` to the nearest integer.
fn rounded_share(step: i64, extent: i64, steps: i64) -> i64 {
    (2 * step * extent + steps).div_euclid(2 * steps)
}

/// `None` outside the grid.
fn probability(grid: &Grid<Occupancy>, column: i64, row: i64) -> Option<f64> {
    let index =
        CellIndex { column: usize::try_from(column).ok()?, row: usize::try_from(row).ok()? };
    let cell = grid.get(index)?;
    Some(cell.probability().unwrap_or(0.5))
}

#[cfg(test)]
mod tests {
    use super::reliability;
    use ogm_core::{GridFrame, Occupancy, OccupancyGrid, Se2};

    fn map(picture: &str) -> OccupancyGrid {
        let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap()
    }

    #[test]
    fn a_door_lowers_it_by_its_share() {
        let wall = map("####....##");
        let (occupied, free) =
            (Occupancy::OCCUPIED.probability().unwrap(), Occupancy::FREE.probability().unwrap());
        let mean = reliability(wall.cells(), [[0, 0], [9, 0]], 0);
        assert!((mean - (0.6 * occupied + 0.4 * free)).abs() < 1e-12);
        let reversed = reliability(wall.cells(), [[9, 0], [0, 0]], 0);
        assert!((mean - reversed).abs() < 1e-12);
    }

    #[test]
    fn unknown_counts_one_half_and_outside_not_at_all() {
        assert_eq!(reliability(map("????").cells(), [[0, 0], [3, 0]], 5), 0.5);
    }

    #[test]
    fn the_band_forgives_a_segment_beside_a_thin_wall() {
        let wall = map("....\n####");
        let occupied = Occupancy::OCCUPIED.probability().unwrap();
        let beside = [[0, 1], [3, 1]];
        assert!((reliability(wall.cells(), beside, 1) - occupied).abs() < 1e-12);
        assert!(reliability(wall.cells(), beside, 0) < 0.2);

        let upright = map(".#\n.#\n.#");
        assert!((reliability(upright.cells(), [[0, 0], [0, 2]], 1) - occupied).abs() < 1e-12);
    }
}
