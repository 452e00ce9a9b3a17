//! The worked examples of Tsardoulias et al., section 4.1.2, and what must hold for any walls.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use nalgebra::Point2;
use ogm_core::{Outcome, Refusal, Segment, wrap_period};
use ogm_vector::{
    Estimator, GroupRule, OgmVector, Params, Weights, angle_histogram, ogm_vector, wall_rotation,
};
use proptest::prelude::{Just, Strategy, prop, prop_assert, proptest};

/// Table 1, degrees.
const TABLE_1: [f64; 6] = [2.0, 90.0, -1.0, -89.0, 179.0, 79.0];

fn wall(degrees: f64, length: f64, reliability: f64) -> Segment {
    let direction = degrees.to_radians();
    Segment {
        start: Point2::new(1.0, -2.0),
        end: Point2::new(1.0 + length * direction.cos(), -2.0 + length * direction.sin()),
        direction,
        reliability,
        support: 50,
    }
}

fn walls(degrees: &[f64]) -> Vec<Segment> {
    degrees.iter().map(|&angle| wall(angle, 3.0, 0.9)).collect()
}

fn found(segments: &[Segment], params: &Params) -> OgmVector {
    ogm_vector(segments, params).found().unwrap()
}

fn bisecting() -> Params {
    Params { estimator: Estimator::Bisector, ..Params::default() }
}

fn as_printed() -> Params {
    Params { weights: Weights::AsPrinted, ..Params::paper() }
}

fn group_degrees(vector: &OgmVector, group: usize) -> f64 {
    vector.group_directions()[group].unwrap().to_degrees()
}

#[test]
fn t_v1_table_1_becomes_table_2() {
    let table_2 = [2.0, 90.0, -1.0, 91.0, -1.0, 79.0];
    let printed = Params { grouping: GroupRule::AsPrinted, ..Params::paper() };
    for params in [Params::default(), Params::paper(), printed] {
        let vector = found(&walls(&TABLE_1), &params);
        for (group, members) in [[0, 2, 4], [1, 3, 5]].into_iter().enumerate() {
            let grouped = &vector.groups[group].members;
            assert!(grouped.iter().map(|member| member.segment).eq(members));
            for member in grouped {
                let degrees = member.direction.to_degrees();
                assert!((degrees - table_2[member.segment]).abs() < 1e-12, "{member:?}");
            }
        }
    }
}

#[test]
fn t_v2_means_of_table_2() {
    let bisector = found(&walls(&TABLE_1), &bisecting());
    assert!(group_degrees(&bisector, 0).abs() < 1e-12);
    assert!((group_degrees(&bisector, 1) - 260.0 / 3.0).abs() < 1e-12);
    assert!((bisector.direction.to_degrees() - (130.0 / 3.0 - 45.0)).abs() < 1e-12);

    let four_fold = found(&walls(&TABLE_1), &Params::default());
    assert!((four_fold.direction.to_degrees() + 1.564_333).abs() < 1e-6);
    assert!((four_fold.strength - 0.956_079).abs() < 1e-6);
    assert!((four_fold.theta_ogm().to_degrees() + 46.564_333).abs() < 1e-6);
}

#[test]
fn t_v3_the_printed_weights_prefer_the_worst_walls() {
    let two = [wall(0.0, 200.0, 0.98), wall(10.0, 40.0, 0.62)];
    let three = [wall(2.0, 100.0, 0.99), wall(-1.0, 100.0, 0.98), wall(-1.0, 30.0, 0.61)];
    for (segments, corrected, printed) in
        [(&two[..], 1.12319, 7.91667), (&three[..], 0.379_471, -0.795_918)]
    {
        let vector = found(segments, &Params::paper());
        assert!((group_degrees(&vector, 0) - corrected).abs() < 5e-6);
        assert!((vector.direction.to_degrees() - corrected).abs() < 5e-6);
        assert!(vector.single_direction && !vector.weights_fell_back);
        assert!((group_degrees(&found(segments, &as_printed()), 0) - printed).abs() < 5e-6);
    }
}

#[test]
fn t_v3_perfect_walls_fall_back_to_their_length() {
    let perfect = [wall(0.0, 30.0, 1.0), wall(4.0, 10.0, 1.0), wall(90.0, 5.0, 1.0)];
    let vector = found(&perfect, &as_printed());
    assert!(vector.weights_fell_back);
    assert!((group_degrees(&vector, 0) - 1.0).abs() < 1e-12);
    assert!((vector.direction.to_degrees() - 0.5).abs() < 1e-12);
    assert!(!found(&perfect, &Params::paper()).weights_fell_back);
}

#[test]
fn t_v6_grouping_wraps_where_the_printed_rule_does_not() {
    let printed = Params { grouping: GroupRule::AsPrinted, ..Params::default() };
    for (first, second, group, direction, printed_direction) in
        [(100.0, -170.0, 1, 190.0, 10.0), (170.0, -175.0, 0, 185.0, 5.0)]
    {
        let segments = walls(&[first, second]);
        let grouped = |group: usize, params: &Params| {
            let vector = found(&segments, params);
            vector.groups[group]
                .members
                .iter()
                .find(|member| member.segment == 1)
                .unwrap()
                .direction
        };
        let degrees = grouped(group, &Params::default()).to_degrees();
        assert!((degrees - direction).abs() < 1e-9, "{degrees}");
        let degrees = grouped(0, &printed).to_degrees();
        assert!((degrees - printed_direction).abs() < 1e-9, "{degrees}");
    }
}

/// Walls within 10° of a rectangle at any rotation.
fn rectangular() -> impl Strategy<Value = Vec<Segment>> {
    let deviation = (-10.0_f64..10.0, 0_i32..2, 0.5_f64..9.0, 0.6_f64..1.0);
    (-45.0_f64..45.0, prop::collection::vec(deviation, 1..12)).prop_map(|(rotation, walls)| {
        let walls = walls.into_iter();
        walls
            .map(|(off, turns, length, reliability)| {
                wall(rotation + off + 90.0 * f64::from(turns), length, reliability)
            })
            .collect()
    })
}

proptest! {
    #[test]
    fn t_v4_order_ends_and_half_turns_do_not_matter(
        (segments, shuffled) in rectangular().prop_flat_map(|s| (Just(s.clone()), Just(s).prop_shuffle())),
        changes in prop::collection::vec((prop::bool::ANY, -1_i32..2), 12),
    ) {
        let changed: Vec<_> = shuffled.iter().zip(changes).map(|(segment, (swap, turns))| {
            let (start, end) = if swap { (segment.end, segment.start) } else { (segment.start, segment.end) };
            let direction = segment.direction + f64::from(turns) * std::f64::consts::PI;
            Segment { start, end, direction, ..*segment }
        }).collect();
        for params in [Params::default(), bisecting()] {
            let difference = wall_rotation(&found(&segments, &params), &found(&changed, &params));
            prop_assert!(difference.abs() < 1e-9, "{difference}");
        }
    }

    #[test]
    fn t_v5_turning_the_walls_turns_the_direction(segments in rectangular(), any_angle in -180.0_f64..180.0) {
        for params in [Params::default(), bisecting(), Params::paper()] {
            for angle in [-45.0, -44.9, 0.0, 44.9, 45.0, 90.0, 180.0, any_angle] {
                let angle = f64::to_radians(angle);
                let turned: Vec<_> = segments.iter()
                    .map(|s| Segment { direction: s.direction + angle, ..*s }).collect();
                let rotation = wall_rotation(&found(&turned, &params), &found(&segments, &params));
                let error = wrap_period(rotation - angle, std::f64::consts::FRAC_PI_2);
                prop_assert!(error.abs() < 1e-9, "{error} at {angle}");
            }
        }
    }
}

#[test]
fn walls_that_say_nothing_are_refused_or_left_out() {
    let not_finite = wall(f64::NAN, 1.0, 0.9);
    let point = wall(30.0, 0.0, 0.9);
    let cancelling = walls(&[0.0, 45.0]);
    for segments in [&[][..], &[not_finite, point][..], &cancelling] {
        let expected = Refusal::NoLines { candidates: segments.len() };
        assert_eq!(ogm_vector(segments, &Params::default()), Outcome::Refused(expected));
    }
    let vector = found(&[point, not_finite, wall(7.0, 2.0, 0.9)], &Params::default());
    assert!((vector.direction.to_degrees() - 7.0).abs() < 1e-12);
    assert_eq!(vector.groups[0].members[0].segment, 2);
}

#[test]
fn a_building_without_right_angles_is_weak() {
    let triangle = walls(&[0.0, 60.0, -60.0]);
    assert!(found(&triangle, &bisecting()).weak);
    assert!(!found(&walls(&TABLE_1), &Params::default()).weak);
}

#[test]
fn the_histogram_holds_every_metre_in_its_direction() {
    let segments =
        [wall(-90.0, 2.0, 0.9), wall(89.0, 3.0, 0.9), wall(90.0, 4.0, 0.9), wall(1.0, 5.0, 0.9)];
    let metres = angle_histogram(&segments, 4);
    for (bin, expected) in [6.0, 0.0, 5.0, 3.0].into_iter().enumerate() {
        assert!((metres[bin] - expected).abs() < 1e-12, "{metres:?}");
    }
    assert!(angle_histogram(&segments, 0).is_empty());
}
