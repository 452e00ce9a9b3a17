//! What a user of the default rule relies on: no wall is lost, none is there twice.

use std::f64::consts::PI;

use grid_merge::{Claim, FusionParams, FusionRule, PlacedMap, fusion_quality, merge, provenance};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::{CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};

fn drawn(picture: &str) -> OccupancyGrid {
    let frame = GridFrame::new(0.1, Se2::identity()).expect("a valid frame");
    OccupancyGrid::from_ascii(frame, picture).expect("a picture")
}

fn here(map: &OccupancyGrid) -> PlacedMap<'_> {
    PlacedMap::new(map, Se2::identity())
}

fn merged(maps: &[PlacedMap<'_>]) -> grid_merge::Merged {
    merge(maps, &FusionParams::default(), &()).expect("maps that can be merged")
}

/// A room of `width` by `height` metres with walls of 12 cm and a partition, free inside, unknown
/// outside.
fn room(resolution: f64, origin: Se2) -> OccupancyGrid {
    let frame = GridFrame::new(resolution, origin).expect("a valid frame");
    let (width, height) = (6.4, 9.6);
    // The last cells may be cut.
    let cells = |metres: f64| (0..).take_while(|&n| f64::from(n) * resolution < metres).count();
    let mut grid =
        Grid::filled(cells(width), cells(height), Occupancy::UNKNOWN).expect("a valid grid");
    let thick = 0.12;
    for row in 0..grid.height() {
        for column in 0..grid.width() {
            let [x, y] = [column, row].map(|cell| (cell as f64 + 0.5) * resolution);
            let inside = (0.5..width - 0.5).contains(&x) && (0.5..height - 0.5).contains(&y);
            let edge = [x - 0.5, width - 0.5 - x, y - 0.5, height - 0.5 - y];
            let wall = edge.iter().any(|&depth| depth < thick);
            let partition = (y - 4.0).abs() < 0.5 * thick && x < 4.0;
            *grid.get_mut(CellIndex { column, row }).expect("inside") = match inside {
                false => Occupancy::UNKNOWN,
                true if wall || partition => Occupancy::OCCUPIED,
                true => Occupancy::FREE,
            };
        }
    }
    OccupancyGrid::new(frame, grid)
}

#[test]
fn a_wall_a_cell_beside_the_surer_maps_wall_is_that_wall() {
    let (first, second) = (drawn("..#..\n..#.."), drawn("...#.\n...#."));
    let merged = merged(&[here(&first), here(&second)]);
    assert_eq!(merged.map.to_ascii(), "..#..\n..#..\n");
    assert_eq!((merged.conflict_count, merged.compared), (0, 10));
}

#[test]
fn the_wall_stays_where_the_less_uncertain_pose_has_it() {
    let (first, second, third) = (drawn("......"), drawn("..#..."), drawn("...#.."));
    let with = |map, sigma: f64| PlacedMap {
        covariance: Some(Matrix3::from_diagonal_element(sigma * sigma)),
        ..here(map)
    };
    for (sigmas, expected) in [([0.01, 0.02], "..#...\n"), ([0.02, 0.01], "...#..\n")] {
        let maps = [here(&first), with(&second, sigmas[0]), with(&third, sigmas[1])];
        assert_eq!(merged(&maps).map.to_ascii(), expected, "{sigmas:?}");
    }
}

#[test]
fn a_wall_in_the_free_space_of_another_map_stays_and_is_reported() {
    let first = drawn("#.........\n#.........\n#.........");
    let second = drawn("#.........\n#.....##..\n#.....#...");
    let merged = merged(&[here(&first), here(&second)]);
    assert_eq!(merged.map.to_ascii(), second.to_ascii());
    let [region] = &merged.regions[..] else { panic!("{:?}", merged.regions) };
    assert_eq!((region.cells, merged.conflict_count, merged.region_count), (3, 3, 1));
    assert_eq!((&region.occupied[..], &region.free[..]), (&[1][..], &[0][..]));
    assert!((region.centre - Point2::new(2.05 / 3.0, 0.35 / 3.0)).norm() < 1e-9);
    assert!((region.size - Vector2::new(0.2, 0.2)).norm() < 1e-9);
}

#[test]
fn what_the_pose_leaves_open_is_no_conflict_and_stays_an_obstacle() {
    let (first, second) = (drawn("..#......."), drawn(".....#...."));
    let sure = [here(&first), here(&second)];
    let unsure =
        PlacedMap { covariance: Some(Matrix3::from_diagonal_element(0.01)), ..here(&second) };
    let bent = PlacedMap { bend_m: 0.1, ..here(&second) };
    let conflicts = merged(&sure);
    assert_eq!(conflicts.conflict_count, 2);
    for second in [unsure, bent] {
        let merged = merged(&[sure[0], second]);
        assert_eq!((merged.conflict_count, merged.regions.len()), (0, 0));
        assert_eq!(merged.map, conflicts.map);
    }
}

#[test]
fn a_wall_that_goes_on_where_the_surer_map_ends_has_no_gap() {
    let (first, second) = (drawn("###....\n......."), drawn("???####\n???...."));
    assert_eq!(merged(&[here(&first), here(&second)]).map.to_ascii(), "#######\n.......\n");
    let (first, second) = (drawn("###????"), drawn("???####"));
    assert_eq!(merged(&[here(&first), here(&second)]).map.to_ascii(), "#######\n");
}

#[test]
fn two_walls_that_agree_are_surer_than_one_and_free_space_likewise() {
    let map = drawn("#.");
    let cells = merged(&[here(&map), here(&map)]).map.cells().cells().to_vec();
    let twice = Occupancy::from_probability(0.81 / 0.82);
    assert_eq!(cells, [twice, Occupancy::from_byte(254 - twice.byte())]);
}

#[test]
fn provenance_tells_which_map_says_what() {
    let (first, second) = (drawn("#.?"), drawn("#??"));
    let params = FusionParams::default();
    let told = provenance(&[here(&first), here(&second)], &params, &()).unwrap();
    let claims = told.cells.map(|&claim| told.claims[usize::from(claim)].clone());
    let claim = |occupied: &[usize], free: &[usize]| Claim {
        occupied: occupied.to_vec(),
        free: free.to_vec(),
    };
    assert_eq!(claims.cells(), [claim(&[0, 1], &[]), claim(&[], &[0]), Claim::default()]);
    assert_eq!(told.frame, *merged(&[here(&first), here(&second)]).map.frame());
}

#[test]
fn the_quality_of_a_merge_counts_what_happened() {
    let first = drawn("........\n#.......\n#.......");
    let second = drawn("........\n##...#..\n##...#..");
    let maps = [here(&first), here(&second)];
    let thresholds = ClassThresholds::default();
    let params = FusionParams { fusion: FusionRule::First, ..FusionParams::default() };
    let mut merged = merge(&maps, &params, &()).unwrap();
    let quality = fusion_quality(&maps, &merged, &thresholds).unwrap();
    assert_eq!(quality.inputs.iter().map(|input| input.walls).collect::<Vec<_>>(), [2, 6]);
    assert_eq!(quality.inputs.iter().map(|input| input.lost).collect::<Vec<_>>(), [0, 2]);
    assert!((quality.lost() - 2.0 / 6.0).abs() < 1e-12);
    assert_eq!((quality.walls, quality.agreed_free, quality.closed), (2, 18, 0));
    // A cell thick in the first; in the second four cells of six are a diagonal of a cell thick.
    let second_cells = (4.0 * 2.0_f64.sqrt() + 2.0) / 6.0;
    assert!((quality.wall_thickness_m - 0.1).abs() < 1e-6);
    assert!((quality.inputs[1].wall_thickness_m - 0.1 * second_cells).abs() < 1e-6);
    assert!((quality.thicker_cells(0.1) - (1.0 - second_cells)).abs() < 1e-6);

    *merged.map.cells_mut().get_mut(CellIndex { column: 3, row: 2 }).unwrap() = Occupancy::OCCUPIED;
    let quality = fusion_quality(&maps, &merged, &thresholds).unwrap();
    assert_eq!((quality.agreed_free, quality.closed), (18, 1));
}

/// Free space with what `is_wall` picks by column and row.
fn dotted(resolution: f64, side: usize, is_wall: impl Fn(usize, usize) -> bool) -> OccupancyGrid {
    let frame = GridFrame::new(resolution, Se2::identity()).expect("a valid frame");
    let cells = (0..side * side).map(|at| match is_wall(at % side, at / side) {
        true => Occupancy::OCCUPIED,
        false => Occupancy::FREE,
    });
    OccupancyGrid::new(frame, Grid::new(side, side, cells.collect()).expect("a square"))
}

/// Bands of rows are read at a time; rows of nothing below move every border between two.
#[test]
fn where_the_output_is_cut_changes_no_cell() {
    let shelves = dotted(0.05, 160, |_, row| row % 16 == 0);
    let poses = [Se2::new(0.13, 0.07, 0.03), Se2::new(-0.2, 0.3, -0.04)];
    let at = |rows: usize| {
        let below = -0.05 * (20 + rows) as f64;
        let frame = GridFrame::new(0.05, Se2::new(0.0, below, 0.0)).unwrap();
        let cut = OccupancyGrid::new(frame, Grid::filled(1, 1, Occupancy::UNKNOWN).unwrap());
        let covariance = Some(Matrix3::from_diagonal_element(1e-3));
        let maps = [
            here(&shelves),
            PlacedMap { covariance, bend_m: 0.05, ..PlacedMap::new(&shelves, poses[0]) },
            PlacedMap::new(&shelves, poses[1]),
            here(&cut),
        ];
        let merged = merged(&maps);
        let cells = merged.map.cells().cells().to_vec();
        let conflicts: Vec<_> =
            merged.conflicts.iter().map(|at| (at.column, at.row - rows)).collect();
        (cells[rows * merged.map.width()..].to_vec(), conflicts, merged.region_count)
    };
    let whole = at(0);
    assert!(whole.1.len() > 100 && whole.2 > 1, "there is something to be cut");
    for rows in 1..16 {
        let cut = at(rows);
        assert!(whole.0 == cut.0, "{rows}");
        assert_eq!((&whole.1, whole.2), (&cut.1, cut.2), "{rows}");
    }
}

#[test]
fn a_pole_of_one_cell_stays_however_its_map_is_turned() {
    let poles = dotted(0.05, 80, |column, row| column % 7 == 3 && row % 7 == 3);
    let floor = dotted(0.05, 80, |_, _| false);
    for degrees in 0..90 {
        let pose = Se2::new(0.31, -0.17, f64::from(degrees).to_radians());
        let maps = [here(&floor), PlacedMap::new(&poles, pose)];
        let quality = fusion_quality(&maps, &merged(&maps), &ClassThresholds::default()).unwrap();
        assert_eq!((quality.inputs[1].walls, quality.inputs[1].lost), (121, 0), "{degrees}");
    }
}

#[test]
fn the_same_room_seen_twice_stays_as_thin_and_has_no_conflict() {
    let first = room(0.05, Se2::identity());
    for resolution in [0.03, 0.05, 0.065, 0.1] {
        let second = room(resolution, Se2::new(0.3, -0.2, 0.4));
        let mut thicker = Vec::new();
        for step in 0..24 {
            let phase = f64::from(step);
            // The second map shows the same room in a frame of its own, a little off.
            let second_from_first = second.frame().map_from_grid()
                * Se2::new(0.02 * phase.sin(), 0.02 * (1.7 * phase).cos(), 0.0);
            let turned = Se2::new(1.0, 2.0, 0.26 * phase);
            let frame = turned * second.frame().map_from_grid();
            let frame = GridFrame::new(resolution, frame).unwrap();
            let moved = OccupancyGrid::new(frame, second.cells().clone());
            let pose = (turned * second_from_first).inverse();
            let covariance = Some(Matrix3::from_diagonal(&Vector3::new(1e-4, 1e-4, 0.0)));
            let maps = [here(&first), PlacedMap { covariance, ..PlacedMap::new(&moved, pose) }];
            let thresholds = ClassThresholds::default();
            let quality = fusion_quality(&maps, &merged(&maps), &thresholds).unwrap();
            assert!(quality.lost() <= 0.0, "{resolution}, {step}: {quality:?}");
            assert!(quality.conflict_share() <= 0.01, "{resolution}, {step}: {quality:?}");
            thicker.push(quality.thicker_cells(0.05));
        }
        let mean = thicker.iter().sum::<f64>() / 24.0;
        assert!(mean <= 0.5, "{resolution}: {thicker:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_wall_is_lost_and_no_free_space_closed_wherever_maps_of_any_resolution_lie(
        x in -3.0_f64..3.0, y in -3.0_f64..3.0, theta in -PI..PI, yaw in -PI..PI,
        resolution in 0.03_f64..0.15,
    ) {
        let first = room(0.05, Se2::identity());
        let second = room(resolution, Se2::new(0.3, -0.2, yaw));
        let third = room(0.05, Se2::identity());
        let maps = [
            here(&first),
            PlacedMap::new(&second, Se2::new(x, y, theta)),
            PlacedMap::new(&third, Se2::new(-x, y, -0.7 * theta)),
        ];
        let merged = merged(&maps);
        let thresholds = ClassThresholds::default();
        let quality = fusion_quality(&maps, &merged, &thresholds).unwrap();
        prop_assert!(quality.lost() <= 0.0, "{:?}", quality);
        prop_assert!(quality.closed_share() <= 0.005, "{:?}", quality);
    }
}
