//! ψ: the paper's examples, its traps, and a slow second opinion.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use carpin_walk::{DistanceParams, MapDistance, Objective, psi};
use ogm_core::{
    CellClass, CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2,
    l1_distance, warp_nearest,
};
use proptest::prelude::{Strategy, prop, prop_assert, proptest};
use std::f64::consts::PI;

fn map(picture: &str) -> OccupancyGrid {
    map_in(Se2::identity(), picture)
}

fn map_in(map_from_grid: Se2, picture: &str) -> OccupancyGrid {
    let frame = GridFrame::new(0.14, map_from_grid).expect("a frame");
    OccupancyGrid::from_ascii(frame, picture).expect("a picture of a map")
}

fn classes(picture: &str) -> Grid<CellClass> {
    map(picture).cells().map(|&cell| ClassThresholds::default().classify(cell))
}

#[test]
fn t_c1_distances_of_two_seeds() {
    let mut mask = Grid::filled(5, 5, false).unwrap();
    for (column, row) in [(1, 1), (4, 3)] {
        *mask.get_mut(CellIndex { column, row }).unwrap() = true;
    }
    let expected =
        [[2, 1, 2, 3, 3], [1, 0, 1, 2, 2], [2, 1, 2, 2, 1], [3, 2, 2, 1, 0], [4, 3, 3, 2, 1]];
    assert_eq!(l1_distance(&mask).unwrap().cells(), expected.as_flattened());
}

/// The first line of a picture is the highest row; that turns both maps over alike.
#[test]
fn t_c2_two_small_maps() {
    let m1 = classes("##??\n..??\n????\n????");
    let m2 = classes("????\n?##?\n?..?\n????");
    assert_eq!(psi(&m1, &m2).unwrap().psi, 6.0);
    assert_eq!(psi(&m2, &m1).unwrap().psi, 6.0);
    assert_eq!(psi(&m1, &m1).unwrap().psi, 0.0);
    let free_only = classes("????\n????\n?..?\n????");
    let found = psi(&m1, &free_only).unwrap();
    assert_eq!((found.psi, found.common_classes), (15.0, 1), "12 for the missing obstacles");
}

#[test]
fn t_c3_maps_of_nothing_look_alike_and_say_so() {
    let nothing = classes("??\n??");
    let found = psi(&nothing, &nothing).unwrap();
    assert_eq!((found.psi, found.no_information), (0.0, true));
    let free = classes("..\n..");
    assert!(!psi(&nothing, &free).unwrap().no_information);
    assert!(psi(&nothing, &classes("?")).is_err(), "pictures of different size");
}

/// A map that slides off: with padding ψ keeps growing, and what cells are lost never makes it
/// better than an honest match.
#[test]
fn a_source_that_leaves_the_target_never_looks_better() {
    let row = format!("#{}#", ".".repeat(18));
    let picture =
        format!("{}\n{}{}", "#".repeat(20), format!("{row}\n").repeat(18), "#".repeat(20));
    let map = map(&picture);
    let shifted = |padding, cells: f64| {
        let params = DistanceParams { padding, ..DistanceParams::default() };
        let target_from_source = Se2::new(cells * 0.14, 0.0, 0.0);
        MapDistance::new(&map, &map, &params).unwrap().psi(&target_from_source).unwrap().psi
    };
    let padded: Vec<f64> = (0..=10).map(|cells| shifted(0.5, f64::from(cells))).collect();
    assert!(padded[0] == 0.0 && padded.is_sorted_by(|a, b| a < b), "{padded:?}");
    assert!(shifted(0.0, 10.0) < 0.8 * padded[10], "cells dropped off the target are forgotten");
    assert_eq!(shifted(0.5, 1000.0), 2.0 * 2.0 * 78.0, "nothing left on 40 × 40 cells");
    assert_eq!(shifted(0.0, 1000.0), 2.0 * 2.0 * 38.0);
}

#[test]
fn the_overlap_looks_at_what_both_maps_know() {
    let left = map("######\n#....?\n#....?\n######");
    let both = |objective, cells: f64| {
        let params = DistanceParams { objective, ..DistanceParams::default() };
        let right = map("######\n?....#\n?....#\n######");
        let mut distance = MapDistance::new(&left, &right, &params).unwrap();
        distance.psi(&Se2::new(cells * 0.14, 0.0, 0.0)).unwrap().psi
    };
    let overlap = Objective::Overlap { min_share: 0.25 };
    assert_eq!(both(overlap, 3.0), 0.0, "the right half of a building where it belongs");
    assert!(both(Objective::Picture, 3.0) > 2.0, "what only one robot saw counts");
    assert_eq!(both(overlap, 5.0), f64::INFINITY, "one column in common");
}

fn picture(width: usize, height: usize) -> impl Strategy<Value = OccupancyGrid> {
    let cell = prop::sample::select(vec![
        Occupancy::UNKNOWN,
        Occupancy::UNKNOWN,
        Occupancy::OCCUPIED,
        Occupancy::FREE,
    ]);
    prop::collection::vec(cell, width * height).prop_map(move |cells| {
        let frame = GridFrame::new(0.14, Se2::new(1.0, -2.0, 0.4)).unwrap();
        OccupancyGrid::new(frame, Grid::new(width, height, cells).unwrap())
    })
}

fn classified(map: &OccupancyGrid) -> Grid<CellClass> {
    map.cells().map(|&cell| ClassThresholds::default().classify(cell))
}

/// ψ by the definition, cell against cell, on the whole canvas.
fn by_definition(m1: &Grid<CellClass>, m2: &Grid<CellClass>) -> f64 {
    let cells = |map: &Grid<CellClass>, class| -> Vec<CellIndex> {
        map.indexed().filter(|(_, cell)| **cell == class).map(|(at, _)| at).collect()
    };
    let directed = |a: &[CellIndex], b: &[CellIndex]| {
        let to = |p: &CellIndex, q: &CellIndex| p.column.abs_diff(q.column) + p.row.abs_diff(q.row);
        let nearest = |p| b.iter().map(|q| to(p, q)).min().unwrap();
        a.iter().map(nearest).sum::<usize>() as f64 / a.len() as f64
    };
    let term = |class| match (cells(m1, class), cells(m2, class)) {
        (a, b) if a.is_empty() && b.is_empty() => 0.0,
        (a, b) if a.is_empty() || b.is_empty() => 2.0 * (m1.width() + m1.height() - 2) as f64,
        (a, b) => directed(&a, &b) + directed(&b, &a),
    };
    term(CellClass::Occupied) + term(CellClass::Free)
}

proptest! {
    #[test]
    fn psi_is_a_dissimilarity(a in picture(9, 7), b in picture(9, 7)) {
        let (a, b) = (classified(&a), classified(&b));
        let (there, back) = (psi(&a, &b).unwrap(), psi(&b, &a).unwrap());
        prop_assert!(there.psi >= 0.0 && (there.psi - back.psi).abs() < 1e-12);
        prop_assert!(psi(&a, &a).unwrap().psi == 0.0);
        prop_assert!((there.psi - by_definition(&a, &b)).abs() < 1e-12);
    }

    /// The same as warping the source onto the whole canvas and comparing cell against cell.
    #[test]
    fn under_a_transform_it_is_that_of_the_pictures_on_the_canvas(
        target in picture(8, 6), source in picture(5, 7),
        x in -1.5_f64..1.5, y in -1.5_f64..1.5, turn in -PI..PI,
    ) {
        let target_from_source = Se2::new(x, y, turn);
        let params = DistanceParams::default();
        let mut distance = MapDistance::new(&target, &source, &params).unwrap();
        let found = distance.psi(&target_from_source).unwrap();

        let (canvas, size) = (target.frame().shifted(-4, -4), (8 + 8, 6 + 8));
        let on_canvas = |map: &OccupancyGrid, canvas_from_map: &Se2| {
            let unknown = CellClass::Unknown;
            warp_nearest(&classified(map), map.frame(), &canvas, size, canvas_from_map, unknown).unwrap()
        };
        let expected = by_definition(
            &on_canvas(&target, &Se2::identity()),
            &on_canvas(&source, &target_from_source),
        );
        prop_assert!((found.psi - expected).abs() < 1e-9, "{} instead of {expected}", found.psi);
    }

    #[test]
    fn a_placement_is_its_transform(
        target in picture(8, 6), x in -3.0_f64..3.0, y in -3.0_f64..3.0, turn in -PI..PI,
    ) {
        let source = map_in(Se2::new(-3.0, 0.5, 2.0), "#..\n?.#");
        let distance = MapDistance::new(&target, &source, &DistanceParams::default()).unwrap();
        let target_from_source = Se2::new(x, y, turn);
        let back = distance.target_from_source(&distance.placement(&target_from_source));
        let error = back.between(&target_from_source);
        prop_assert!(error.translation().norm() < 1e-9 && error.theta().abs() < 1e-9);
    }
}
