//! What a user of a merged map relies on.

use std::f64::consts::{FRAC_PI_2, PI};

use grid_merge::{
    FusionError, FusionParams, FusionRule, GapTreatment, Interpolation, Mapping, PlacedCoverage,
    PlacedMap, merge, merge_coverage, transform_grid,
};
use ogm_core::{
    CellIndex, ClassThresholds, Grid, GridError, GridFrame, Occupancy, OccupancyGrid, Se2,
};
use proptest::prelude::{ProptestConfig, prop_assert, prop_assert_eq, proptest};

const RESOLUTION: f64 = 0.05;

fn frame(x: f64, y: f64, yaw: f64) -> GridFrame {
    GridFrame::new(RESOLUTION, Se2::new(x, y, yaw)).expect("a valid grid")
}

/// A room with a pillar that no turn maps onto itself; walls four cells thick, unknown outside.
fn room(frame: GridFrame) -> OccupancyGrid {
    let (width, height) = (90, 70);
    let cells = (0..height).flat_map(|row| {
        (0..width).map(move |column| {
            let inside = (8..82).contains(&column) && (6..64).contains(&row);
            let free = (12..78).contains(&column) && (10..60).contains(&row);
            let pillar = (20..30).contains(&column) && (40..46).contains(&row);
            match (inside, free && !pillar) {
                (false, _) => Occupancy::UNKNOWN,
                (true, true) => Occupancy::FREE,
                (true, false) => Occupancy::OCCUPIED,
            }
        })
    });
    OccupancyGrid::new(frame, Grid::new(width, height, cells.collect()).expect("a valid grid"))
}

fn placed(map: &OccupancyGrid, reference_from_map: Se2) -> PlacedMap<'_> {
    PlacedMap::new(map, reference_from_map)
}

fn all_mappings() -> [Mapping; 3] {
    [
        Mapping::Inverse(Interpolation::Nearest),
        Mapping::Inverse(Interpolation::Bilinear),
        FusionParams::paper().mapping,
    ]
}

#[test]
fn the_first_map_keeps_its_cells_and_the_frame_is_the_reference() {
    let (first, second) = (room(frame(-1.03, 2.07, 0.0)), room(frame(0.4, -0.2, 0.3)));
    for mapping in all_mappings() {
        let params = FusionParams { mapping, fusion: FusionRule::First, ..FusionParams::default() };
        let maps = [placed(&first, Se2::identity()), placed(&second, Se2::new(1.2, -0.7, 0.4))];
        let merged = merge(&maps, &params, &()).unwrap().map;
        assert_eq!(merged.frame().map_from_grid().theta(), 0.0);
        for (index, &cell) in first.cells().indexed() {
            let point = first.frame().cell_centre(index);
            if cell.is_known() {
                assert_eq!(merged.at(point), cell, "{mapping:?} at {index:?}");
            }
        }
        assert!(merged.width() > first.width(), "the second map widens it");
    }
}

#[test]
fn a_map_merged_with_itself_has_no_conflict_and_more_certainty() {
    let map = room(frame(0.0, 0.0, 0.0));
    let merged = merge(&[placed(&map, Se2::identity()); 2], &FusionParams::default(), &()).unwrap();
    let known = map.cells().cells().iter().filter(|cell| cell.is_known()).count();
    assert_eq!((merged.compared, merged.conflict_count), (known, 0));
    let strengthened = Occupancy::from_probability(0.81 / 0.82);
    assert_eq!(
        merged.map.at(map.frame().cell_centre(CellIndex { column: 9, row: 30 })),
        strengthened
    );
}

#[test]
fn conflicts_are_shown_where_they_are() {
    let first = OccupancyGrid::from_ascii(frame(0.0, 0.0, 0.0), "..#?").unwrap();
    let second = OccupancyGrid::from_ascii(frame(0.05, 0.0, 0.0), "#.#").unwrap();
    let maps = [placed(&first, Se2::identity()), placed(&second, Se2::identity())];
    let params = FusionParams { fusion: FusionRule::LogOdds, ..FusionParams::default() };
    let merged = merge(&maps, &params, &()).unwrap();
    assert_eq!(merged.map.to_ascii(), ".++#\n");
    assert_eq!(merged.conflicts.to_grid().cells(), [false, true, true, false]);
    assert_eq!((merged.compared, merged.conflict_count), (2, 2));
}

#[test]
fn three_maps_give_the_same_bytes_in_any_order() {
    let rooms = [(0.0, 0.0, 0.0), (0.31, 0.2, 0.7), (-0.5, 0.13, -2.0)];
    let rooms = rooms.map(|(x, y, yaw)| (room(frame(0.0, 0.0, 0.0)), Se2::new(x, y, yaw)));
    let anchor = OccupancyGrid::from_ascii(frame(0.0, 0.0, 0.0), "?").unwrap();
    for fusion in [FusionRule::KeepWalls, FusionRule::LogOdds, FusionRule::Occupied] {
        let params = FusionParams { fusion, ..FusionParams::default() };
        let merged = |order: [usize; 3]| {
            let mut maps = vec![placed(&anchor, Se2::identity())];
            maps.extend(order.map(|index| placed(&rooms[index].0, rooms[index].1)));
            merge(&maps, &params, &()).unwrap()
        };
        let one = merged([0, 1, 2]);
        assert!(one.conflict_count > 100, "the rooms must disagree somewhere");
        for order in [[2, 0, 1], [1, 0, 2]] {
            let other = merged(order);
            assert_eq!(one.map, other.map, "{fusion:?}");
            assert_eq!(one.conflicts, other.conflicts, "{fusion:?}");
        }
    }
}

#[test]
fn a_finer_map_keeps_its_thin_walls_in_a_coarser_output() {
    let fine_frame = GridFrame::new(0.02, Se2::identity()).unwrap();
    let mut fine = OccupancyGrid::new(fine_frame, Grid::filled(60, 40, Occupancy::FREE).unwrap());
    for cell in &mut fine.cells_mut().cells_mut()[60 * 17..60 * 18] {
        *cell = Occupancy::OCCUPIED;
    }
    let params = FusionParams { resolution: Some(RESOLUTION), ..FusionParams::default() };
    let coarse = transform_grid(&fine, &Se2::new(0.3, 0.1, 0.0), &params, &()).unwrap();
    assert_eq!(coarse.frame().resolution(), RESOLUTION);
    let walls = coarse.occupied_points(&ClassThresholds::default());
    assert_eq!(walls.len(), 24, "1.2 m of wall in cells of 0.05 m");
    assert!(walls.iter().all(|point| (point.y - 0.1 - 0.35).abs() <= 0.035));
}

#[test]
fn coverage_lies_where_the_map_it_belongs_to_lies() {
    let (first, second) = (room(frame(0.0, 0.0, 0.0)), room(frame(0.0, 0.0, 0.0)));
    let pose = Se2::new(0.72, -0.31, 2.2);
    for mapping in [Mapping::default(), FusionParams::paper().mapping] {
        let params = FusionParams { mapping, ..FusionParams::default() };
        let maps = [placed(&first, Se2::identity()), placed(&second, pose)];
        let merged = merge(&maps, &params, &()).unwrap().map;
        let known = first.cells().map(|cell| cell.is_known());
        let fields = maps.map(|placed| PlacedCoverage {
            covered: &known,
            frame: placed.map.frame(),
            reference_from_map: placed.reference_from_map,
        });
        let covered = merge_coverage(&fields, &merged, &params).unwrap();
        assert_eq!(covered, merged.cells().map(|cell| cell.is_known()), "{mapping:?}");

        let cut = OccupancyGrid::new(*first.frame(), first.cells().clone());
        let inside = merge_coverage(&fields, &cut, &params).unwrap();
        assert_eq!((inside.width(), inside.height()), (cut.width(), cut.height()));
        for (index, &covered) in inside.indexed() {
            let known = merged.at(cut.frame().cell_centre(index)).is_known();
            // A hole at the cut has fewer neighbours to be filled from.
            let at_cut =
                index.column == 0 || index.row == 0 || index.column == 89 || index.row == 69;
            assert!(at_cut || covered == known, "{mapping:?} at {index:?}");
        }
    }
}

#[test]
fn what_cannot_be_meant_is_an_error() {
    let map = room(frame(0.0, 0.0, 0.0));
    let params = FusionParams::default();
    assert_eq!(merge(&[], &params, &()), Err(FusionError::NoMaps));
    let nan = [placed(&map, Se2::identity()), placed(&map, Se2::new(f64::NAN, 0.0, 0.0))];
    assert!(matches!(merge(&nan, &params, &()), Err(FusionError::NonFinitePose { map: 1, .. })));
    let far = [placed(&map, Se2::identity()), placed(&map, Se2::new(1e7, 1e7, 0.0))];
    assert!(matches!(
        merge(&far, &params, &()),
        Err(FusionError::Grid(GridError::TooLarge { .. }))
    ));
    for resolution in [1e-9, 0.0, f64::NAN] {
        let params = FusionParams { resolution: Some(resolution), ..params };
        let merged = merge(&[placed(&map, Se2::identity())], &params, &());
        assert!(matches!(merged, Err(FusionError::Grid(_))), "{resolution}");
    }
    let finer = FusionParams { resolution: Some(0.02), ..FusionParams::paper() };
    let scattered = transform_grid(&map, &Se2::new(0.0, 0.0, 0.3), &finer, &());
    assert!(matches!(scattered, Err(FusionError::TooCoarseToScatter { map: 0, .. })));
}

#[test]
fn forward_mapping_by_quarter_turns_is_exact_under_every_gap_treatment_that_keeps_values() {
    let map = room(frame(0.0, 0.0, 0.0));
    let inverse =
        transform_grid(&map, &Se2::new(0.5, 0.25, FRAC_PI_2), &FusionParams::default(), &());
    for gaps in [GapTreatment::None, GapTreatment::HoleFill] {
        let params = FusionParams {
            mapping: Mapping::Forward { rounding: Default::default(), gaps },
            ..FusionParams::default()
        };
        let forward = transform_grid(&map, &Se2::new(0.5, 0.25, FRAC_PI_2), &params, &());
        assert_eq!(forward, inverse, "{gaps:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_cell_is_known_exactly_where_the_source_is(
        x in -3.0_f64..3.0, y in -3.0_f64..3.0, theta in -PI..PI, yaw in -PI..PI, bilinear in proptest::bool::ANY,
    ) {
        let map = room(frame(0.3, -0.4, yaw));
        let target_from_source = Se2::new(x, y, theta);
        let interpolation = if bilinear { Interpolation::Bilinear } else { Interpolation::Nearest };
        let params = FusionParams {
            mapping: Mapping::Inverse(interpolation),
            ..FusionParams::default()
        };
        let moved = transform_grid(&map, &target_from_source, &params, &()).unwrap();
        for (index, cell) in moved.cells().indexed() {
            let point = target_from_source.inverse() * moved.frame().cell_centre(index);
            let cells = map.frame().cells_from_point(point);
            let at_border = [cells.x, cells.y].iter().any(|c| (c - c.round()).abs() < 1e-6);
            prop_assert!(at_border || cell.is_known() == map.at(point).is_known(), "{:?}", index);
        }
    }

    // One wall four cells thick may gain or lose a row of cells, by where it falls on the lattice.
    #[test]
    fn classes_keep_their_share_on_average_over_where_the_lattice_falls(
        theta in -PI..PI, yaw in -PI..PI,
    ) {
        let map = room(frame(0.3, -0.4, yaw));
        let thresholds = ClassThresholds::default();
        let counts = |map: &OccupancyGrid| {
            let cells = map.cells().cells();
            let occupied = cells.iter().filter(|&&cell| thresholds.is_occupied(cell)).count();
            let free = cells.iter().filter(|&&cell| thresholds.is_free(cell)).count();
            [occupied as f64, free as f64]
        };
        let mut mean = [0.0; 2];
        for phase in 0..16 {
            let offset = |step: i32| RESOLUTION * 0.25 * f64::from(step);
            let target_from_source = Se2::new(offset(phase % 4), offset(phase / 4), theta);
            let moved = transform_grid(&map, &target_from_source, &FusionParams::default(), &()).unwrap();
            let counted = counts(&moved);
            mean = [mean[0] + counted[0] / 16.0, mean[1] + counted[1] / 16.0];
        }
        for (after, before) in mean.into_iter().zip(counts(&map)) {
            prop_assert!((after / before - 1.0).abs() < 0.02, "{} of {}", after, before);
        }
    }

    #[test]
    fn a_move_and_its_inverse_give_the_map_back_inside(
        x in -3.0_f64..3.0, y in -3.0_f64..3.0, theta in -PI..PI,
    ) {
        let map = room(frame(0.3, -0.4, 0.0));
        let target_from_source = Se2::new(x, y, theta);
        let params = FusionParams::default();
        let there = transform_grid(&map, &target_from_source, &params, &()).unwrap();
        let back = transform_grid(&there, &target_from_source.inverse(), &params, &()).unwrap();
        // Two nearest-cell steps move a value by less than two cells, so it was near before.
        for (index, &cell) in map.cells().indexed() {
            let near: Vec<Occupancy> = (-2..=2_i64).flat_map(|dy| (-2..=2_i64).map(move |dx| (dx, dy)))
                .filter_map(|(dx, dy)| {
                    let column = usize::try_from(index.column as i64 + dx).ok()?;
                    let row = usize::try_from(index.row as i64 + dy).ok()?;
                    map.cells().get(CellIndex { column, row }).copied()
                }).collect();
            let uniform = near.len() == 25 && near.iter().all(|&other| other == cell);
            prop_assert!(!uniform || back.at(map.frame().cell_centre(index)) == cell, "{:?}", index);
        }
    }

    #[test]
    fn where_the_maps_lie_together_in_the_reference_frame_changes_no_statistics(
        column in -400_i32..400, row in -400_i32..400,
    ) {
        let (first, second) = (room(frame(0.2, 0.1, 0.0)), room(frame(0.0, 0.0, 0.0)));
        let first_from_second = Se2::new(0.33, -0.21, 0.6);
        let shift = Se2::new(RESOLUTION * f64::from(column), RESOLUTION * f64::from(row), 0.0);
        let params = FusionParams::default();
        let here = merge(&[placed(&first, Se2::identity()), placed(&second, first_from_second)], &params, &()).unwrap();
        let there = merge(&[placed(&first, shift), placed(&second, shift * first_from_second)], &params, &()).unwrap();
        prop_assert_eq!(here.map.cells(), there.map.cells());
        prop_assert_eq!(here.conflicts, there.conflicts);
    }
}
