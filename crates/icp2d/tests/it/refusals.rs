//! Where there is no answer, none is given.

use icp2d::{IcpError, IcpParams, Pairing, Termination, WallPoint, WallPoints, align};
use nalgebra::{Point2, Vector2};
use ogm_core::{Length, Refusal, Se2};

use crate::walls::{floor, found, in_cells, moved, set, wall};

fn refusal(target: Vec<WallPoint>, source: Vec<WallPoint>) -> Refusal {
    let outcome = align(&set(target), &set(source), Se2::identity(), &in_cells()).unwrap();
    outcome.refusal().unwrap().clone()
}

#[test]
fn maps_of_different_places_are_refused() {
    let elsewhere = moved(&floor(), Se2::new(400.0, 0.0, 0.0));
    let none = Refusal::TooFewPairs { have: 0, need: 10 };
    assert_eq!(refusal(floor(), elsewhere), none);
    // The bounding boxes meet here, the walls do not.
    let inside = wall([95, 40], [95, 90], Some(-Vector2::x()));
    let other_face = wall([89, 40], [89, 90], Some(Vector2::x()));
    assert_eq!(refusal(inside, other_face), none);
}

#[test]
fn too_few_points_are_refused() {
    for (target, source, have) in
        [(vec![], vec![], 0), (floor(), vec![], 0), (wall([0, 0], [8, 0], None), floor(), 9)]
    {
        let expected = Refusal::TooLittleStructure { have, need: 10 };
        assert_eq!(refusal(target, source), expected);
    }
}

#[test]
fn a_search_that_runs_away_gives_back_its_start() {
    let start = Se2::new(8.3, 0.4, 0.0);
    let params = IcpParams { max_translation: Length::cells(4.0), ..in_cells() };
    let floor = set(floor());
    let found = found(align(&floor, &floor, start, &params).unwrap());
    assert_eq!(found.target_from_source, start);
    let Termination::MovedTooFar { translation, .. } = found.termination else {
        panic!("{found:?}");
    };
    assert!((translation - 8.3_f64.hypot(0.4)).abs() < 1e-6, "{translation}");
    assert!(found.rmse > 0.1 && found.initial_rmse == Some(found.rmse));
}

#[test]
fn the_last_iteration_is_not_convergence() {
    let params = IcpParams { max_iterations: 2, ..in_cells() };
    let floor = set(floor());
    let found = found(align(&floor, &floor, Se2::new(5.0, 3.0, 0.02), &params).unwrap());
    assert_eq!(found.termination, Termination::IterationLimit);
    assert_eq!(found.iterations, 2);
}

#[test]
fn numbers_that_cannot_be_meant_are_errors() {
    let at = |x| WallPoint { position: Point2::new(x, 0.0), free_side: None };
    for x in [f64::NAN, f64::INFINITY, 1e300] {
        let error = WallPoints::from_points(vec![at(0.0), at(x)], 1.0).unwrap_err();
        assert!(matches!(error, IcpError::InvalidPoint { index: 1, .. }), "{error}");
    }
    for side in [Vector2::zeros(), Vector2::new(f64::NAN, 1.0), Vector2::new(2.0, 0.0)] {
        let point = WallPoint { free_side: Some(side), ..at(0.0) };
        let error = WallPoints::from_points(vec![point], 1.0).unwrap_err();
        assert!(matches!(error, IcpError::InvalidFreeSide { index: 0, .. }), "{error}");
    }
    for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(WallPoints::from_points(vec![], spacing).is_err(), "{spacing}");
    }

    let floor = set(floor());
    let start = Se2::new(0.0, f64::NAN, 0.0);
    let error = align(&floor, &floor, start, &in_cells()).unwrap_err();
    assert!(matches!(error, IcpError::Grid(_)));

    let paper = in_cells();
    let wrong = [
        ("distance_factor", IcpParams { distance_factor: 1.0, ..paper }),
        (
            "max_correspondence_distance",
            IcpParams { max_correspondence_distance: Length::metres(f64::NAN), ..paper },
        ),
        (
            "max_correspondence_distance",
            IcpParams { initial_correspondence_distance: Length::metres(f64::INFINITY), ..paper },
        ),
        ("min_correspondences", IcpParams { min_correspondences: 1, ..paper }),
        ("pairing", IcpParams { pairing: Pairing::Trimmed(0.0), ..paper }),
        ("rotation_epsilon", IcpParams { rotation_epsilon: -1.0, ..paper }),
    ];
    for (expected, params) in wrong {
        match align(&floor, &floor, Se2::identity(), &params) {
            Err(IcpError::Parameter(error)) => assert_eq!(error.name, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
}

#[test]
fn a_start_beyond_all_bounds_is_refused_and_does_not_overflow() {
    let floor = set(floor());
    let start = Se2::new(1e300, -1e300, 1.0);
    let outcome = align(&floor, &floor, start, &in_cells()).unwrap();
    assert!(matches!(outcome.refusal(), Some(Refusal::TooFewPairs { .. })));
}
