//! Walls of a grid that goes through a deformation.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use map_warp::{Motion, Warp, WarpError, WarpParams, warp_grid};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::{
    CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Se2,
};

/// Two storeys of rooms of 12 by 6 m with walls of one cell, seen from a frame that is turned.
fn rooms() -> OccupancyGrid {
    let (width, height) = (240, 120);
    let frame = GridFrame::new(0.05, Se2::new(2.0, -1.0, 0.4)).unwrap();
    let mut cells = Grid::filled(width, height, Occupancy::UNKNOWN).unwrap();
    for row in 10..=110 {
        for column in 10..=230 {
            let is_wall = (row - 10) % 50 == 0 || (column - 10) % 55 == 0 || row * 2 == column;
            let cell = if is_wall { Occupancy::OCCUPIED } else { Occupancy::FREE };
            *cells.get_mut(CellIndex { column, row }).unwrap() = cell;
        }
    }
    OccupancyGrid::new(frame, cells)
}

/// Patches of which every other one moves in, so that rooms shrink and widen.
fn warp(by_m: f64, turn: f64) -> Warp {
    let map = rooms();
    let motions: Vec<Motion> = (0..12)
        .map(|i| {
            let (column, row) = (20 + 60 * (i % 4), 15 + 45 * (i / 4));
            let sign = if (i + i / 4) % 2 == 0 { 1.0 } else { -1.0 };
            Motion {
                at: map.frame().cell_centre(CellIndex { column, row }),
                shift: Vector2::new(by_m * sign, -0.7 * by_m * sign),
                turn: turn * sign,
                covariance: Matrix3::from_diagonal(&Vector3::new(1e-4, 1e-4, 1e-4)),
            }
        })
        .collect();
    let params = WarpParams { correlation_m: 3.0, outlier_sigmas: 1e9, ..WarpParams::default() };
    Warp::fit(&motions, &params).unwrap()
}

fn through(map: &OccupancyGrid, warp: &Warp) -> OccupancyGrid {
    warp_grid(map, warp, &ClassThresholds::default(), &()).unwrap()
}

fn farthest(from: &[Point2<f64>], to: &[Point2<f64>]) -> f64 {
    let nearest = |a: &Point2<f64>| to.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
    from.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn every_wall_comes_out_in_its_place_and_no_other_does() {
    let map = rooms();
    let walls = map.occupied_points(&ClassThresholds::default());
    for (by_m, turn) in [(0.05, 0.0), (0.2, 0.05), (0.4, -0.1)] {
        let warp = warp(by_m, turn);
        let moved: Vec<_> = walls.iter().map(|&wall| warp.apply(wall)).collect();
        let rigid: Vec<_> = walls.iter().map(|&wall| warp.straight_from_map() * wall).collect();
        let out = through(&map, &warp).occupied_points(&ClassThresholds::default());
        let (lost, made) = (farthest(&moved, &out) / 0.05, farthest(&out, &moved) / 0.05);
        assert!(lost <= 1.5 && made <= 1.5, "{by_m} m: {lost} and {made} cells");
        let growth = out.len() as f64 / walls.len() as f64;
        assert!((0.85..1.15).contains(&growth), "{by_m} m: walls grew by {growth}");
        assert!(by_m < 0.1 || farthest(&rigid, &out) / 0.05 > 2.5, "the rigid part does it all");
    }
}

#[test]
fn walls_that_shrink_together_are_not_lost() {
    let map = rooms();
    let motions: Vec<Motion> = [(-1.0, 0.4), (1.0, -0.4)]
        .map(|(along, shift)| {
            let middle = map.frame().cell_centre(CellIndex { column: 120, row: 60 });
            Motion {
                at: middle + Vector2::new(along, 0.0),
                shift: Vector2::new(shift, 0.0),
                turn: 0.0,
                covariance: Matrix3::from_diagonal(&Vector3::new(1e-4, 1e-4, 1e-4)),
            }
        })
        .to_vec();
    let params = WarpParams {
        correlation_m: 1.0,
        drift_sigma_m: 0.5,
        outlier_sigmas: 1e9,
        ..WarpParams::default()
    };
    let warp = Warp::fit(&motions, &params).unwrap();
    let middle = map.frame().cell_centre(CellIndex { column: 120, row: 60 });
    assert!(warp.jacobian(middle).determinant() < 0.8);
    let walls = map.occupied_points(&ClassThresholds::default());
    let moved: Vec<_> = walls.iter().map(|&wall| warp.apply(wall)).collect();
    let out = through(&map, &warp).occupied_points(&ClassThresholds::default());
    let lost = farthest(&moved, &out) / 0.05;
    assert!(lost <= 1.5, "{lost} cells");
}

#[test]
fn no_motions_give_the_same_map() {
    let map = rooms();
    let warp = Warp::fit(&[], &WarpParams::default()).unwrap();
    let out = through(&map, &warp);
    for (index, &cell) in map.cells().indexed() {
        assert_eq!(out.at(map.frame().cell_centre(index)), cell, "{index:?}");
    }
    let known = |map: &OccupancyGrid| map.cells().cells().iter().filter(|c| c.is_known()).count();
    assert_eq!(known(&out), known(&map));
}

#[test]
fn cells_as_coarse_as_the_bend_still_look_up_their_own_place() {
    let motions = [(20.0, 1.0), (26.0, -1.0), (32.0, 1.0)].map(|(x, shift)| Motion {
        at: Point2::new(x, 20.0),
        shift: Vector2::new(0.0, shift),
        turn: 0.0,
        covariance: Matrix3::from_diagonal(&Vector3::new(1e-4, 1e-4, 1.0)),
    });
    let params = WarpParams {
        drift_sigma_m: 1.0,
        correlation_m: 3.0,
        outlier_sigmas: 1e9,
        ..WarpParams::default()
    };
    let warp = Warp::fit(&motions, &params).unwrap();
    let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
    // Probabilities that differ from cell to cell, none of them a wall.
    let mut cells = Grid::filled(52, 40, Occupancy::FREE).unwrap();
    for (at, cell) in cells.cells_mut().iter_mut().enumerate() {
        *cell = Occupancy::from_byte(u8::try_from(at * 7 % 101).unwrap());
    }
    let map = OccupancyGrid::new(frame, cells);
    let out = through(&map, &warp);
    for (index, &cell) in out.cells().indexed() {
        let origin = warp.inverse(out.frame().cell_centre(index));
        assert_eq!(cell, map.at(origin), "{index:?} from {origin}");
    }
}

#[test]
fn a_grid_is_cancelled_when_progress_says_so() {
    struct Never;
    impl Progress for Never {
        fn report(&self, _share: f64) {}

        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let stopped = warp_grid(&rooms(), &warp(0.1, 0.0), &ClassThresholds::default(), &Never);
    assert!(matches!(stopped, Err(WarpError::Cancelled(_))));
}
