//! A start outside the basin of the alignment is found again, one inside it is left alone.

use icp2d::{IcpError, IcpParams, StartParams, WallPoint, WallPoints, align, search_start};
use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, Se2};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};

const SPACING: f64 = 0.05;

/// The inner faces of a room of 8 × 5 m with two pillars, each point with its free side.
fn room() -> WallPoints {
    let mut points = Vec::new();
    let mut face = |from: Point2<f64>, to: Point2<f64>, side: Vector2<f64>| {
        let along = to - from;
        let steps = (along.norm() / SPACING).round();
        let mut at = 0.0;
        while at <= steps {
            let position = from + along * (at / steps);
            points.push(WallPoint { position, free_side: Some(side) });
            at += 1.0;
        }
    };
    for (x, y, width, height, inwards) in
        [(0.0, 0.0, 8.0, 5.0, 1.0), (2.0, 1.5, 0.3, 0.3, -1.0), (5.2, 3.1, 0.4, 0.7, -1.0)]
    {
        let (left, right, low, high) = (x, x + width, y, y + height);
        let corner = Point2::new;
        face(corner(left, low), corner(right, low), Vector2::new(0.0, inwards));
        face(corner(left, high), corner(right, high), Vector2::new(0.0, -inwards));
        face(corner(left, low), corner(left, high), Vector2::new(inwards, 0.0));
        face(corner(right, low), corner(right, high), Vector2::new(-inwards, 0.0));
    }
    WallPoints::from_points(points, SPACING).unwrap()
}

fn found(target: &WallPoints, source: &WallPoints, start_target_from_source: Se2) -> Se2 {
    let params = StartParams::default();
    search_start(target, source, start_target_from_source, &params).unwrap().found().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_start_beyond_the_gate_is_brought_into_the_basin(
        x in -0.9_f64..0.9, y in -0.9_f64..0.9, degrees in -4.5_f64..4.5,
    ) {
        let room = room();
        let start_target_from_source =
            Se2::about(Point2::new(4.0, 2.5), degrees.to_radians(), Vector2::new(x, y));
        let better_target_from_source = found(&room, &room, start_target_from_source);
        let alignment = align(&room, &room, better_target_from_source, &IcpParams::default());
        let target_from_source = alignment.unwrap().found().unwrap().target_from_source;
        let corner = Point2::new(8.0, 5.0);
        let error = (target_from_source * corner - corner).norm();
        prop_assert!(error < SPACING, "{error} m left of a start {x}, {y}, {degrees}°");
    }
}

#[test]
fn a_start_that_fits_comes_back_unchanged() {
    let room = room();
    let start_target_from_source = Se2::new(0.002, -0.001, 0.0002);
    let kept_target_from_source = found(&room, &room, start_target_from_source);
    assert_eq!(kept_target_from_source, start_target_from_source);
}

#[test]
fn a_corridor_does_not_slide() {
    let wall = |y: f64, side: f64| {
        (0..200_i32).map(move |i| WallPoint {
            position: Point2::new(f64::from(i) * SPACING, y),
            free_side: Some(Vector2::new(0.0, side)),
        })
    };
    let points = wall(0.0, 1.0).chain(wall(2.0, -1.0)).collect();
    let corridor = WallPoints::from_points(points, SPACING).unwrap();
    let start_target_from_source = Se2::new(0.3, 0.0, 0.0);
    let kept_target_from_source = found(&corridor, &corridor, start_target_from_source);
    assert_eq!(kept_target_from_source, start_target_from_source);
}

#[test]
fn walls_out_of_reach_are_refused_and_nonsense_is_an_error() {
    let room = room();
    let far_target_from_source = Se2::new(50.0, 0.0, 0.0);
    let outcome = search_start(&room, &room, far_target_from_source, &StartParams::default());
    assert_eq!(outcome, Ok(Outcome::Refused(Refusal::TooFewPairs { have: 0, need: 1 })));

    let nan_target_from_source = Se2::new(f64::NAN, 0.0, 0.0);
    let outcome = search_start(&room, &room, nan_target_from_source, &StartParams::default());
    assert!(matches!(outcome, Err(IcpError::Grid(_))));
    let endless = StartParams { max_rotation: f64::INFINITY, ..StartParams::default() };
    let outcome = search_start(&room, &room, Se2::identity(), &endless);
    assert!(matches!(outcome, Err(IcpError::Parameter(_))));
}
