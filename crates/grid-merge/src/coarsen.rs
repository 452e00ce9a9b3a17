//! A map at a coarser resolution that still has its thin walls.

use ogm_core::{ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Steps};

use crate::FusionError;
use crate::evidence::{ByteOfLogOdds, LogOddsOfByte, MeanLogOdds};

/// `map` at `resolution` metres a cell, same origin pose: what two maps of different resolution
/// are brought to before they are aligned.
///
/// Every source cell counts in the coarse cell that contains its centre. That one is occupied if
/// any of its cells is (mean log-odds of those), so a wall one cell thick keeps its cells; else the
/// mean log-odds of its known cells; unknown where none is known. A resolution that is the same to
/// a relative 1e-6 gives a copy.
///
/// # Errors
/// A resolution that is finer than the map's or no usable number.
pub fn coarsen(
    map: &OccupancyGrid,
    resolution: f64,
    thresholds: &ClassThresholds,
) -> Result<OccupancyGrid, FusionError> {
    coarsen_in_rows(map, resolution, thresholds, &())
}

/// [`coarsen`] that can be cancelled between rows.
pub(crate) fn coarsen_in_rows(
    map: &OccupancyGrid,
    resolution: f64,
    thresholds: &ClassThresholds,
    progress: &dyn Progress,
) -> Result<OccupancyGrid, FusionError> {
    let frame = GridFrame::new(resolution, map.frame().map_from_grid())?;
    if frame.same_resolution(map.frame()) {
        return Ok(map.clone());
    }
    let have = map.frame().resolution();
    let ratio = resolution / have;
    if ratio < 1.0 {
        let asked = resolution;
        return Err(FusionError::FinerThanSource { have, asked });
    }
    let width = coarse_cell(map.width() - 1, ratio) + 1;
    let height = coarse_cell(map.height() - 1, ratio) + 1;
    let mut coarse = Grid::filled(width, height, Occupancy::UNKNOWN)?;

    let log_odds = LogOddsOfByte::new();
    let rounding = ByteOfLogOdds::new();
    let columns: Vec<usize> = (0..map.width()).map(|column| coarse_cell(column, ratio)).collect();
    let mut means = vec![MeanLogOdds::default(); width];
    let done = Steps::new(progress, height);
    let mut fine_rows = map.cells().rows().enumerate().peekable();
    for (row, output) in coarse.cells_mut().chunks_exact_mut(width).enumerate() {
        means.fill(MeanLogOdds::default());
        while let Some((_, fine)) = fine_rows.next_if(|&(fine, _)| coarse_cell(fine, ratio) <= row)
        {
            for (&cell, &column) in fine.iter().zip(&columns) {
                if cell.is_known() {
                    means[column].add(log_odds.of(cell), thresholds.is_occupied(cell));
                }
            }
        }
        done.step()?;
        for (cell, sum) in output.iter_mut().zip(&means) {
            if let Some(mean) = sum.mean() {
                *cell = rounding.round(mean);
            }
        }
    }
    Ok(OccupancyGrid::new(frame, coarse))
}

/// The coarse column or row that contains the centre of a fine one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and not above the fine cell"
)]
fn coarse_cell(fine: usize, ratio: f64) -> usize {
    // A ratio such as 0.06/0.04 is not exact; centres on a border belong to the upper cell.
    ((fine as f64 + 0.5) / ratio + 1e-9) as usize
}

#[cfg(test)]
mod tests {
    use super::coarsen;
    use crate::FusionError;
    use ogm_core::{CellClass, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
    use proptest::prelude::{Just, prop, prop_assert, prop_assert_eq, prop_oneof, proptest};

    fn map(resolution: f64, picture: &str) -> OccupancyGrid {
        let frame = GridFrame::new(resolution, Se2::new(1.0, -2.0, 0.3)).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap()
    }

    fn coarse_picture(resolution: f64, picture: &str, to: f64) -> String {
        let thresholds = ClassThresholds::default();
        coarsen(&map(resolution, picture), to, &thresholds).unwrap().to_ascii()
    }

    #[test]
    fn whole_ratios_group_cells() {
        let picture = "...???\n.#.???\n...??.\n......\n......\n......";
        assert_eq!(coarse_picture(0.02, picture, 0.06), "#.\n..\n");
        assert_eq!(coarse_picture(0.05, "....??\n#...??", 0.1), "#.?\n");
    }

    #[test]
    fn ratios_between_whole_numbers_keep_every_wall() {
        // Centres 0.5 | 1.5 2.5 | 3.5 | 4.5 5.5 of cells 1.5 wide.
        assert_eq!(coarse_picture(0.04, "#.....", 0.06), "#...\n");
        assert_eq!(coarse_picture(0.04, ".#....", 0.06), ".#..\n");
        assert_eq!(coarse_picture(0.04, "..#...", 0.06), ".#..\n");
        assert_eq!(coarse_picture(0.04, "...#..", 0.06), "..#.\n");
        assert_eq!(coarse_picture(0.05, "#.......", 0.08), "#....\n");
    }

    #[test]
    fn the_same_resolution_is_a_copy_and_a_finer_one_an_error() {
        let (source, thresholds) = (map(0.05, "#.?"), ClassThresholds::default());
        assert_eq!(coarsen(&source, f64::from(0.05_f32), &thresholds).unwrap(), source);
        let finer = coarsen(&source, 0.04, &thresholds);
        assert_eq!(finer, Err(FusionError::FinerThanSource { have: 0.05, asked: 0.04 }));
        for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let bad = coarsen(&source, resolution, &thresholds);
            assert!(matches!(bad, Err(FusionError::Grid(_))), "{resolution}");
        }
        assert_eq!(coarsen(&source, 1e3, &thresholds).unwrap().to_ascii(), "#\n");
    }

    proptest! {
        #[test]
        fn walls_and_explored_area_survive_and_nothing_is_invented(
            width in 1_usize..16, height in 1_usize..16, ratio in 1.01_f64..5.0,
            cells in prop::collection::vec(prop_oneof![
                Just(Occupancy::UNKNOWN), Just(Occupancy::FREE), Just(Occupancy::OCCUPIED),
            ], 16 * 16),
        ) {
            let thresholds = ClassThresholds::default();
            let frame = GridFrame::new(0.02, Se2::new(1.0, -2.0, 0.3)).unwrap();
            let fine = OccupancyGrid::new(
                frame, Grid::new(width, height, cells[..width * height].to_vec()).unwrap());
            let coarse = coarsen(&fine, 0.02 * ratio, &thresholds).unwrap();
            prop_assert_eq!(coarse.frame().map_from_grid(), frame.map_from_grid());

            let mut expected = coarse.cells().map(|_| CellClass::Unknown);
            for (index, &cell) in fine.cells().indexed() {
                let at = coarse.cell_at(frame.cell_centre(index));
                let slot = at.and_then(|at| expected.get_mut(at)).expect("inside the coarse map");
                match thresholds.classify(cell) {
                    CellClass::Occupied => *slot = CellClass::Occupied,
                    CellClass::Free if *slot == CellClass::Unknown => *slot = CellClass::Free,
                    _ => {}
                }
            }
            let classes = coarse.cells().map(|&cell| thresholds.classify(cell));
            prop_assert!(classes == expected, "{}", coarse.to_ascii());
        }
    }
}
