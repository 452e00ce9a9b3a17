//! Whole maps: what is found, what is refused, and what must not matter.

use nalgebra::Point2;
use ogm_core::{
    CellIndex, Grid, GridFrame, Occupancy, OccupancyGrid, Outcome, Refusal, Se2, wrap_angle,
};
use radon_merge::{
    EntropyHistogram, JointCounts, Objective, RadonError, RadonParams, SegmentParams,
    TranslationParams, find_transform, joint_entropy, tune_translation,
};

/// Walls, from and to, of a floor that has no symmetry; metres.
const WALLS: [[f64; 4]; 11] = [
    [0.0, 0.0, 8.0, 0.0],
    [8.0, 0.0, 8.0, 6.0],
    [8.0, 6.0, 0.0, 6.0],
    [0.0, 6.0, 0.0, 0.0],
    [3.0, 0.0, 3.0, 2.2],
    [3.0, 2.2, 4.4, 2.2],
    [0.0, 4.0, 1.6, 4.0],
    [5.5, 6.0, 5.5, 4.3],
    [5.5, 4.3, 6.4, 4.3],
    [8.0, 2.6, 6.9, 2.6],
    [6.9, 2.6, 6.9, 1.4],
];

/// The floor as seen in a frame of its own, from x = `from` to `to`, in cells of 0.05 m.
fn map(world_from_map: Se2, from: f64, to: f64) -> OccupancyGrid {
    let size = 230;
    let frame = GridFrame::new(0.05, Se2::new(-5.75, -5.75, 0.0)).expect("a valid map");
    let mut cells = Grid::filled(size, size, Occupancy::UNKNOWN).expect("a valid map");
    for row in 0..size {
        for column in 0..size {
            let index = CellIndex { column, row };
            let at = world_from_map * frame.cell_centre(index);
            let distance =
                WALLS.iter().map(|wall| distance(at, wall)).fold(f64::INFINITY, f64::min);
            let inside = at.x > from && at.x < to && at.y > -0.1 && at.y < 6.1;
            *cells.get_mut(index).expect("a valid map") = match (inside, distance <= 0.08) {
                (false, _) => Occupancy::UNKNOWN,
                (true, true) => Occupancy::OCCUPIED,
                (true, false) => Occupancy::FREE,
            };
        }
    }
    OccupancyGrid::new(frame, cells)
}

fn distance(point: Point2<f64>, &[x, y, to_x, to_y]: &[f64; 4]) -> f64 {
    let (start, end) = (Point2::new(x, y), Point2::new(to_x, to_y));
    let along = end - start;
    let share = ((point - start).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (start + along * share - point).norm()
}

/// Few segments and candidates: the floor is small.
fn params() -> RadonParams {
    let mut params = RadonParams::default();
    params.segments = SegmentParams { points: 40, max_segments: 250, ..params.segments };
    params.hypotheses.max_candidates = 6;
    params
}

const WORLD_FROM_TARGET: (f64, f64, f64) = (3.0, 3.0, 0.2);

fn target() -> OccupancyGrid {
    let (x, y, theta) = WORLD_FROM_TARGET;
    map(Se2::new(x, y, theta), -0.1, 6.6)
}

fn true_target_from_source(world_from_source: Se2) -> Se2 {
    let (x, y, theta) = WORLD_FROM_TARGET;
    Se2::new(x, y, theta).between(&world_from_source)
}

fn assert_found(outcome: &Outcome<Se2>, truth_target_from_source: Se2, what: &str) {
    let Outcome::Found(target_from_source) = outcome else { panic!("{what}: {outcome:?}") };
    let error = truth_target_from_source.between(target_from_source);
    assert!(error.translation().norm() < 0.1, "{what}: {error:?}");
    assert!(wrap_angle(error.theta()).abs() < 0.015, "{what}: {error:?}");
}

fn assert_found_when_turned_by(degrees: f64) {
    let world_from_source = Se2::new(4.5, 2.5, degrees.to_radians());
    let source = map(world_from_source, 1.2, 8.1);
    let found = find_transform(&target(), &source, &params(), &()).expect("valid maps");
    let truth_target_from_source = true_target_from_source(world_from_source);
    assert_found(&found.outcome, truth_target_from_source, &format!("{degrees}°"));
}

#[test]
fn maps_turned_half_way_between_quadrants_are_brought_together() {
    assert_found_when_turned_by(45.0);
    assert_found_when_turned_by(135.0);
}

#[test]
fn maps_turned_by_any_quarter_are_brought_together() {
    assert_found_when_turned_by(0.0);
    assert_found_when_turned_by(-90.0);
}

#[test]
fn a_map_turned_by_more_than_half_a_turn_is_brought_together() {
    assert_found_when_turned_by(192.8);
}

#[test]
fn swapped_maps_give_the_inverse_and_an_equal_seed_the_same_bits() {
    let world_from_source = Se2::new(4.5, 2.5, 2.0);
    let (target, source) = (target(), map(world_from_source, 1.2, 8.1));
    let truth_target_from_source = true_target_from_source(world_from_source);
    let back = find_transform(&source, &target, &params(), &()).unwrap();
    assert_found(&back.outcome, truth_target_from_source.inverse(), "swapped");
    let again = find_transform(&source, &target, &params(), &()).unwrap();
    assert_eq!(back.outcome, again.outcome);
    assert_eq!((back.compared, back.hypotheses), (again.compared, again.hypotheses));
}

#[test]
fn where_the_origin_of_a_map_lies_does_not_matter() {
    let world_from_source = Se2::new(4.5, 2.5, 2.0);
    let (target, source) = (target(), map(world_from_source, 1.2, 8.1));
    let moved_from_source = Se2::new(30.0, -12.0, 1.1);
    let frame = source.frame();
    let elsewhere = GridFrame::new(0.05, moved_from_source * frame.map_from_grid()).unwrap();
    let moved = OccupancyGrid::new(elsewhere, source.cells().clone());
    let found = find_transform(&target, &moved, &params(), &()).unwrap();
    let truth_target_from_source =
        true_target_from_source(world_from_source) * moved_from_source.inverse();
    assert_found(&found.outcome, truth_target_from_source, "moved");
}

#[test]
fn maps_that_say_too_little_are_refused() {
    let target = target();
    let frame = *target.frame();
    let unknown = OccupancyGrid::new(frame, target.cells().map(|_| Occupancy::UNKNOWN));
    let found = find_transform(&target, &unknown, &params(), &()).unwrap();
    assert!(matches!(found.outcome, Outcome::Refused(Refusal::TooLittleStructure { .. })));
    assert!(found.maps.is_none());

    let mut corridor = target.clone();
    for (position, cell) in corridor.cells_mut().cells_mut().iter_mut().enumerate() {
        *cell = match position / 230 {
            100..103 | 140..143 => Occupancy::OCCUPIED,
            103..140 => Occupancy::FREE,
            _ => Occupancy::UNKNOWN,
        };
    }
    let found = find_transform(&corridor, &corridor, &params(), &()).unwrap();
    assert!(found.outcome.refusal().is_some(), "a bare corridor fits everywhere along itself");
}

#[test]
fn a_floor_of_equal_halves_has_rivals() {
    // The floor and its image turned by half a turn about the middle of its upper wall.
    let frame = GridFrame::new(0.05, Se2::new(-0.5, -0.5, 0.0)).unwrap();
    let mut cells = Grid::filled(180, 260, Occupancy::UNKNOWN).unwrap();
    for row in 0..260 {
        for column in 0..180 {
            let index = CellIndex { column, row };
            let at = frame.cell_centre(index);
            let at = if at.y > 6.0 { Point2::new(8.0 - at.x, 12.0 - at.y) } else { at };
            let inside = at.x > -0.1 && at.x < 8.1 && at.y > -0.1;
            let wall = WALLS.iter().any(|wall| distance(at, wall) <= 0.08);
            *cells.get_mut(index).unwrap() = match (inside, wall) {
                (false, _) => Occupancy::UNKNOWN,
                (true, true) => Occupancy::OCCUPIED,
                (true, false) => Occupancy::FREE,
            };
        }
    }
    let whole = OccupancyGrid::new(frame, cells);
    let found = find_transform(&whole, &whole, &params(), &()).unwrap();
    let rivals = Refusal::SeveralVerified { poses: 2 };
    assert_eq!(found.outcome, Outcome::Refused(rivals));
    assert_eq!(found.accepted, None);
}

#[test]
fn what_cannot_be_meant_is_an_error() {
    let target = target();
    let coarse = GridFrame::new(0.2, Se2::identity()).unwrap();
    let other = OccupancyGrid::new(coarse, target.cells().clone());
    let found = find_transform(&target, &other, &params(), &());
    assert!(matches!(found, Err(RadonError::Grid(_))));
    let mut wrong = params();
    wrong.edges.low = f64::NAN;
    let found = find_transform(&target, &target, &wrong, &());
    assert!(matches!(found, Err(RadonError::Parameter(_))));
    let nowhere = Se2::new(f64::NAN, 0.0, 0.0);
    let thresholds = wrong.thresholds;
    let tuned = tune_translation(&target, &target, nowhere, &thresholds, &wrong.translation);
    assert!(matches!(tuned, Err(RadonError::Grid(_))));
}

#[test]
fn a_translation_that_is_off_by_cells_is_tuned_back() {
    let world_from_source = Se2::new(4.5, 2.5, 2.0);
    let (target, source) = (target(), map(world_from_source, 1.2, 8.1));
    let truth_target_from_source = true_target_from_source(world_from_source);
    let params = TranslationParams::default();
    let start_target_from_source = Se2::new(-0.35, 0.25, 0.0) * truth_target_from_source;
    let thresholds = RadonParams::default().thresholds;
    let window =
        tune_translation(&target, &source, start_target_from_source, &thresholds, &params).unwrap();
    assert_eq!((window.shift, window.entropy_shift), ([7, -5], [7, -5]));
    assert!(!window.is_at_rim());
    let error = truth_target_from_source.between(&window.target_from_source);
    assert!(error.translation().norm() < 1e-9, "{error:?}");

    let by_entropy = TranslationParams { objective: Objective::LeastEntropy, ..params };
    let tuned =
        tune_translation(&target, &source, start_target_from_source, &thresholds, &by_entropy);
    let tuned = tuned.unwrap();
    assert_eq!(tuned.shift, [7, -5]);
    assert_eq!(tuned.target_from_source, window.target_from_source);
    let nothing_in_common = JointCounts { both_unknown: 9, ..JointCounts::default() };
    assert_eq!(radon_merge::similarity(&nothing_in_common, &by_entropy), f64::NEG_INFINITY);

    let objective = Objective::AgreementLessDisagreement;
    let params = TranslationParams { objective, ..params };
    let window =
        tune_translation(&target, &source, start_target_from_source, &thresholds, &params).unwrap();
    assert!(window.is_at_rim(), "more overlap means more agreement of free space");
}

#[test]
fn the_printed_objective_likes_contradiction() {
    let good = JointCounts { both_free: 150, occupied_free: 10, ..JointCounts::default() };
    let bad = JointCounts { both_free: 10, occupied_free: 200, ..JointCounts::default() };
    let printed = TranslationParams { objective: Objective::AsPrinted, ..Default::default() };
    let objective = Objective::AgreementLessDisagreement;
    let corrected = TranslationParams { objective, ..Default::default() };
    let of = |counts: &JointCounts, params| radon_merge::similarity(counts, params);
    assert_eq!((of(&good, &printed), of(&bad, &printed)), (140.0, 190.0));
    assert_eq!((of(&good, &corrected), of(&bad, &corrected)), (140.0, -190.0));
}

#[test]
fn a_mean_picture_cannot_tell_a_conflict_from_the_unknown() {
    let conflict = JointCounts { both_free: 8, occupied_free: 8, ..JointCounts::default() };
    let unknown = JointCounts { both_free: 8, both_unknown: 8, ..JointCounts::default() };
    for (histogram, tells) in
        [(EntropyHistogram::AveragedGrey, false), (EntropyHistogram::KnownInBoth, true)]
    {
        let differ = joint_entropy(&conflict, histogram) != joint_entropy(&unknown, histogram);
        assert_eq!(differ, tells, "{histogram:?}");
    }
}
