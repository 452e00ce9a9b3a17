//! How the answer moves when the maps do.

use grid_match::{MatchParams, match_maps};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use std::f64::consts::FRAC_PI_2;

use crate::world::{OFFICE, apart, draw, found, left_part, right_part};

const CELL: f64 = 0.1;

fn target_pose() -> Se2 {
    Se2::new(2.0, 3.0, 0.35)
}

fn source_pose() -> Se2 {
    Se2::new(9.0, 1.0, -2.1)
}

fn truth() -> Se2 {
    target_pose().between(&source_pose())
}

fn pair() -> (OccupancyGrid, OccupancyGrid) {
    (left_part(OFFICE, target_pose()), right_part(OFFICE, source_pose()))
}

#[test]
fn two_parts_of_a_building_meet_to_a_fraction_of_a_cell() {
    let (target, source) = pair();
    let (shift, turn) = apart(found(&target, &source), truth(), source_pose());
    assert!(shift < 0.25 * CELL, "{shift} m");
    assert!(turn < 0.1_f64.to_radians(), "{turn} rad");
}

#[test]
fn swapping_the_maps_inverts_the_answer() {
    let (target, source) = pair();
    let forth = found(&target, &source);
    let back = found(&source, &target).inverse();
    let (shift, turn) = apart(forth, back, source_pose());
    assert!(shift < 1e-9 && turn < 1e-9, "{shift} m, {turn} rad");
}

#[test]
fn moving_an_origin_moves_the_answer_with_it() {
    let (target, source) = pair();
    let before = found(&target, &source);
    let moved_from_source = Se2::new(-37.0, 12.5, 1.3);
    let frame = GridFrame::new(CELL, moved_from_source * source.frame().map_from_grid()).unwrap();
    let moved = OccupancyGrid::new(frame, source.cells().clone());
    let after = found(&target, &moved) * moved_from_source;
    let (shift, turn) = apart(before, after, source_pose());
    assert!(shift < 1e-9 && turn < 1e-9, "{shift} m, {turn} rad");
}

#[test]
fn an_image_turned_by_a_quarter_gives_the_same_answer() {
    let (target, source) = pair();
    let before = found(&target, &source);
    let (width, height) = (source.width(), source.height());
    let cells = source.cells().cells();
    // Column c and row r of the turned image are row c and column `width − 1 − r` of the first.
    let turned: Vec<Occupancy> = (0..width)
        .flat_map(|row| (0..height).map(move |column| cells[column * width + width - 1 - row]))
        .collect();
    let corner = Se2::new(width as f64 * CELL, 0.0, FRAC_PI_2);
    let frame = GridFrame::new(CELL, source.frame().map_from_grid() * corner).unwrap();
    let turned = OccupancyGrid::new(frame, Grid::new(height, width, turned).unwrap());
    let (shift, turn) = apart(before, found(&target, &turned), source_pose());
    assert!(shift < 0.2 * CELL, "{shift} m");
    assert!(turn < 0.1_f64.to_radians(), "{turn} rad");
}

#[test]
fn half_the_resolution_moves_the_answer_by_less_than_a_cell() {
    let (target, source) = pair();
    let before = found(&target, &source);
    let coarse = draw(OFFICE, [3.2, -0.2, 12.2, 9.2], 2.0 * CELL, source_pose());
    let (shift, turn) = apart(before, found(&target, &coarse), source_pose());
    assert!(shift < 0.5 * CELL, "{shift} m");
    assert!(turn < 0.3_f64.to_radians(), "{turn} rad");
}

#[test]
fn a_map_lies_on_itself() {
    let (target, _) = pair();
    let target_from_source = found(&target, &target);
    let (shift, turn) = apart(target_from_source, Se2::identity(), target_pose());
    assert!(shift < 1e-6 && turn < 1e-6, "{target_from_source:?}");
}

#[test]
fn the_same_maps_give_the_same_report_to_the_last_bit() {
    let (target, source) = pair();
    let report = || format!("{:?}", match_maps(&target, &source, &MatchParams::default(), &()));
    assert_eq!(report(), report());
}
