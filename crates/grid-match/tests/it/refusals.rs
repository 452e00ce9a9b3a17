//! What is not believed, and why.

use grid_match::{Effort, MatchParams, match_maps};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Outcome, Refusal, Se2};
use proptest::prelude::{ProptestConfig, Strategy, any, prop, proptest};
use std::f64::consts::PI;

use crate::world::{CORRIDOR, OFFICE, ROOM, WORKSHOP, among, draw, left_part, matched, right_part};

fn uniform(width: usize, height: usize, value: Occupancy) -> OccupancyGrid {
    let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
    OccupancyGrid::new(frame, Grid::filled(width, height, value).unwrap())
}

#[test]
fn different_buildings_are_refused() {
    let office = left_part(OFFICE, Se2::new(1.0, 1.0, 0.3));
    let workshop = right_part(WORKSHOP, Se2::new(4.0, 2.0, 2.0));
    let outcome = matched(&office, &workshop).outcome;
    assert!(outcome.refusal().is_some(), "{outcome:?}");
}

#[test]
fn maps_without_structure_are_refused_as_such() {
    let building = left_part(OFFICE, Se2::identity());
    let empty = [
        uniform(1, 1, Occupancy::OCCUPIED),
        uniform(1, 1, Occupancy::UNKNOWN),
        uniform(80, 60, Occupancy::UNKNOWN),
        uniform(80, 60, Occupancy::FREE),
    ];
    for map in &empty {
        for (target, source) in [(map, &building), (&building, map), (map, map)] {
            let report = matched(target, source);
            let reason = report.outcome.refusal();
            assert!(matches!(reason, Some(Refusal::TooLittleWall { .. })), "{reason:?}");
            assert!(report.hypotheses.is_empty());
        }
    }
}

#[test]
fn a_map_of_nothing_but_wall_is_refused() {
    let solid = uniform(80, 60, Occupancy::OCCUPIED);
    assert!(matched(&solid, &solid).outcome.refusal().is_some());
}

#[test]
fn a_symmetric_room_is_ambiguous_and_both_poses_are_named() {
    let world_from_source = Se2::new(3.0, 2.0, 1.0);
    let whole = [-0.3, -0.3, 8.3, 5.3];
    let target = draw(ROOM, whole, 0.1, Se2::identity());
    let source = draw(ROOM, whole, 0.1, world_from_source);
    let report = matched(&target, &source);
    let reason = report.outcome.refusal();
    assert!(matches!(reason, Some(Refusal::SeveralPoses { poses: 2, .. })), "{reason:?}");
    let half_turn_about_the_middle = Se2::new(8.0, 5.0, PI);
    for world_from_world in [Se2::identity(), half_turn_about_the_middle] {
        let target_from_source = world_from_world * world_from_source;
        assert!(among(&report.hypotheses, target_from_source, world_from_source));
    }
    let total: f64 = report.hypotheses.iter().map(|hypothesis| hypothesis.pose.probability).sum();
    assert!(total <= 1.0 + 1e-9 && report.hypotheses[0].pose.probability < 0.6);
    let descends = report.hypotheses.is_sorted_by(|a, b| a.pose.probability >= b.pose.probability);
    assert!(descends, "{:?}", report.hypotheses);
}

#[test]
fn a_corridor_names_the_direction_in_which_it_slides() {
    let headings = [0.7, 2.0];
    let west = draw(CORRIDOR, [0.0, -0.08, 12.0, 2.08], 0.1, Se2::new(0.0, 0.0, headings[0]));
    let east = draw(CORRIDOR, [3.0, -0.08, 15.0, 2.08], 0.1, Se2::new(5.0, 1.0, headings[1]));
    for (target, source, heading) in [(&west, &east, headings[0]), (&east, &west, headings[1])] {
        let report = matched(target, source);
        assert!(!matches!(report.outcome, Outcome::Found(_)), "{:?}", report.outcome);
        let weak = report.hypotheses[0].weak_direction.unwrap();
        let along = weak.direction.x * (-heading).cos() + weak.direction.y * (-heading).sin();
        assert!(along.abs() > 0.999, "{weak:?}");
        let relaxed = report.hypotheses[0].evidence.relaxed;
        assert!(relaxed.corners < 0.1 * relaxed.mean().hit_m, "{relaxed:?}");
    }
}

#[test]
fn strips_across_each_other_are_refused() {
    let upright = draw(OFFICE, [-0.1, -0.1, 0.6, 9.1], 0.05, Se2::identity());
    let lying = draw(OFFICE, [-0.1, -0.1, 8.1, 0.6], 0.05, Se2::identity());
    for (target, source) in [(&upright, &lying), (&lying, &upright)] {
        let outcome = matched(target, source).outcome;
        assert!(outcome.refusal().is_some(), "{outcome:?}");
    }
}

fn any_map() -> impl Strategy<Value = OccupancyGrid> {
    let cells = prop::collection::vec(any::<u8>(), 24 * 24);
    let frame = (0.02_f64..1.0, -9.0_f64..9.0, -PI..PI);
    (1_usize..25, 1_usize..25, cells, frame).prop_map(|(width, height, bytes, frame)| {
        let cells = bytes.into_iter().take(width * height).map(Occupancy::from_byte).collect();
        let (resolution, x, yaw) = frame;
        let frame = GridFrame::new(resolution, Se2::new(x, -x, yaw)).unwrap();
        OccupancyGrid::new(frame, Grid::new(width, height, cells).unwrap())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn noise_is_never_merged_and_never_panics(target in any_map(), source in any_map()) {
        let params = MatchParams { min_wall_m: 0.0, ..MatchParams::default() };
        let report = match_maps(&target, &source, &params, &()).unwrap();
        assert!(report.outcome.refusal().is_some(), "{:?}", report.outcome);
    }
}

#[test]
fn maps_a_cell_or_two_wide_are_refused_however_they_are_turned() {
    let params = MatchParams { effort: Effort::Thorough, ..MatchParams::default() };
    for (width, height) in [(1, 115), (154, 1), (2, 130), (3, 90), (97, 2)] {
        for yaw in [2.721, -2.9333, 0.0] {
            let cells = Grid::filled(width, height, Occupancy::OCCUPIED).unwrap();
            let frame = GridFrame::new(0.05, Se2::new(-0.0586, 0.9914, yaw)).unwrap();
            let map = OccupancyGrid::new(frame, cells);
            let report = match_maps(&map, &map, &params, &()).unwrap();
            assert!(report.outcome.refusal().is_some(), "{width} × {height} at {yaw}");
        }
    }
}
