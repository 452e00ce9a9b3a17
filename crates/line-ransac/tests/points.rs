//! Lines among plain points: any frame, members, refusals.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use line_ransac::{Params, PointLine, extract_lines};
use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, Se2, wrap_period};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;

const SPACING: f64 = 0.03;

/// Two walls at a right angle with a centimetre of noise, and after them clutter.
fn corner(frame_from_room: Se2) -> Vec<Point2<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut noise = || 0.01 * (random.random::<f64>() - 0.5);
    let mut points: Vec<_> = (1..100).map(|i| Point2::new(0.03 * f64::from(i), noise())).collect();
    points.extend((1..80).map(|i| Point2::new(noise(), 0.03 * f64::from(i))));
    let clutter = (0..20).map(|_| {
        Point2::new(0.5, 0.5) + 1.5 * Vector2::new(random.random::<f64>(), random.random::<f64>())
    });
    points.extend(clutter.collect::<Vec<_>>());
    points.iter().map(|&point| frame_from_room * point).collect()
}

fn found(points: &[Point2<f64>]) -> Vec<PointLine> {
    extract_lines(points, SPACING, &Params::default()).unwrap().found().unwrap()
}

#[test]
fn the_walls_of_a_corner_come_out_with_their_points_in_any_frame() {
    for frame_from_room in [Se2::identity(), Se2::new(-700.0, 40.0, 2.0), Se2::new(3.0, 0.0, 0.7)] {
        let lines = found(&corner(frame_from_room));
        assert_eq!(lines.len(), 2, "{lines:?}");
        for (from, until, direction, length) in [(0, 99, 0.0, 2.94), (99, 178, 0.5 * PI, 2.34)] {
            let turned = direction + frame_from_room.theta();
            let is_it =
                |line: &&PointLine| wrap_period(line.segment.direction - turned, PI).abs() < 0.01;
            let line = lines.iter().find(is_it).unwrap();
            // The wall that is found first takes the end of the other, as far as the line distance.
            assert!((line.segment.length() - length).abs() < 0.04 + SPACING, "{line:?}");
            assert!(line.segment.reliability > 0.9, "{line:?}");
            let expected: Vec<usize> = (from..until).collect();
            let of_wall = line.members.iter().filter(|member| expected.contains(member)).count();
            assert!(of_wall + 2 >= expected.len(), "{line:?}");
            assert!(line.members.len() <= of_wall + 2, "{line:?}");
            assert_eq!(line.segment.support, line.members.len());
        }
    }
}

#[test]
fn points_that_cannot_be_meant_are_errors_and_too_few_a_refusal() {
    let params = Params::default();
    for bad in [f64::NAN, f64::INFINITY, 1e9] {
        let points = [Point2::origin(), Point2::new(bad, 0.0)];
        assert!(extract_lines(&points, SPACING, &params).is_err(), "{bad}");
    }
    for spacing in [0.0, -1.0, f64::NAN] {
        assert!(extract_lines(&[], spacing, &params).is_err(), "{spacing}");
    }
    for have in [0, 1] {
        let same = vec![Point2::new(1.0, 2.0); 5 * have];
        let outcome = extract_lines(&same, SPACING, &params).unwrap();
        assert_eq!(outcome, Outcome::Refused(Refusal::TooLittleStructure { have, need: 2 }));
    }
}
