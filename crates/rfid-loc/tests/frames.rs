//! Transforms from tags do not depend on where the two maps have their origins, misprints do.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix2, Point2, Vector2};
use ogm_core::{Se2, TagEstimate, wrap_angle};
use proptest::prelude::{Strategy, prop_assert, proptest};
use rfid_loc::{
    RotationParams, SelectionParams, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation, TagPair,
    anchor_on_all_tags, anchor_on_tag, common_tags, least_squares_transform, quadrant, select_tags,
    tag_only_transform, tag_rotation,
};

/// Tags in the source map; the third is 2 cm off in the target, so that no fit is exact.
const PLACES: [[f64; 2]; 4] = [[1.0, 2.0], [4.5, 0.5], [-2.0, 6.0], [8.0, 7.0]];

fn tags(
    target_from_source: Se2,
    target_shift: Vector2<f64>,
    source_shift: Vector2<f64>,
) -> [TagPair; 3] {
    let estimate = |id: u32, position: Point2<f64>| TagEstimate {
        tag_id: id.into(),
        position,
        mode: position,
        covariance: Matrix2::from_diagonal_element(1e-4),
        certainty: 0.99 - 0.01 * f64::from(id),
        misfit: 1.0,
        readings: 300,
        dropped: 0,
        touches_border: false,
        second_peak_ratio: 0.0,
    };
    let (mut target, mut source) = (Vec::new(), Vec::new());
    for (id, place) in (0..).zip(PLACES.map(Point2::from)) {
        let misplaced = if id == 2 { Vector2::new(0.02, 0.0) } else { Vector2::zeros() };
        target.push(estimate(id, target_from_source * place + misplaced + target_shift));
        source.push(estimate(id, place + source_shift));
    }
    let pairs = common_tags(&target, &source).expect("usable estimates");
    select_tags(&pairs, &SelectionParams::default())
        .expect("usable thresholds")
        .found()
        .expect("certain tags")
}

fn tag_only(
    tags: &[TagPair; 3],
    rotation: TagOnlyRotation,
    translation: TagOnlyTranslation,
) -> Se2 {
    let params = TagOnlyParams { rotation, translation, ..TagOnlyParams::default() };
    tag_only_transform(tags, &params).expect("finite input").found().expect("tags apart")
}

/// Every corrected way from tags to a transform; `walls` is the rotation modulo a quarter turn.
fn corrected(tags: &[TagPair; 3], walls: f64) -> [Se2; 5] {
    let params = RotationParams::default();
    let from_tags = tag_rotation(tags, &params).found().expect("tags apart").angle;
    let theta = quadrant(from_tags, walls).expect("finite input").theta;
    [
        tag_only(tags, TagOnlyRotation::P3, TagOnlyTranslation::Corrected),
        tag_only(tags, TagOnlyRotation::P2, TagOnlyTranslation::Corrected),
        least_squares_transform(tags, &params).found().expect("tags apart"),
        anchor_on_tag(theta, &tags[0]).expect("finite input"),
        anchor_on_all_tags(theta, tags).expect("finite input"),
    ]
}

fn shift(by: Vector2<f64>) -> Se2 {
    Se2::new(by.x, by.y, 0.0)
}

/// Largest distance between what two motions make of the tags' surroundings, metres.
fn apart(a: Se2, b: Se2) -> f64 {
    PLACES
        .map(Point2::from)
        .map(|place| (a * place - b * place).norm())
        .into_iter()
        .fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn shifting_an_origin_shifts_corrected_transforms_along(
        theta in -PI..PI,
        target_shift in (-40.0_f64..40.0, -40.0_f64..40.0).prop_map(|(x, y)| Vector2::new(x, y)),
        source_shift in (-40.0_f64..40.0, -40.0_f64..40.0).prop_map(|(x, y)| Vector2::new(x, y)),
    ) {
        let truth = Se2::new(3.0, -2.0, theta);
        let plain = corrected(&tags(truth, Vector2::zeros(), Vector2::zeros()), theta);
        let moved = corrected(&tags(truth, target_shift, source_shift), theta);
        for (plain, moved) in plain.into_iter().zip(moved) {
            let back = shift(-target_shift) * moved * shift(source_shift);
            prop_assert!(apart(plain, back) < 1e-9);
        }
    }

    #[test]
    fn every_quarter_is_recovered_from_walls_known_modulo_a_quarter_turn(
        theta in -PI..PI, quarters in -4_i32..4,
    ) {
        let truth = Se2::new(3.0, -2.0, theta);
        let walls = theta + f64::from(quarters) * FRAC_PI_2;
        for found in corrected(&tags(truth, Vector2::zeros(), Vector2::zeros()), walls) {
            prop_assert!(apart(found, truth) < 0.04, "{found:?}");
        }
    }
}

#[test]
fn the_limits_of_the_quarters_are_recovered_too() {
    for degrees in [-180.0_f64, -135.0, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0] {
        let theta = degrees.to_radians();
        let truth = Se2::new(3.0, -2.0, theta);
        for found in corrected(&tags(truth, Vector2::zeros(), Vector2::zeros()), theta) {
            assert!(wrap_angle(found.theta() - theta).abs() < 0.01, "{degrees}: {found:?}");
        }
    }
}

#[test]
fn swapping_the_maps_inverts_the_transform() {
    let truth = Se2::new(3.0, -2.0, 2.2);
    let (mut target, mut source) = (Vec::new(), Vec::new());
    for pair in tags(truth, Vector2::zeros(), Vector2::zeros()) {
        target.push(*pair.target());
        source.push(*pair.source());
    }
    let select = |target: &[TagEstimate], source: &[TagEstimate]| {
        let pairs = common_tags(target, source).unwrap();
        select_tags(&pairs, &SelectionParams::default())
            .expect("usable thresholds")
            .found()
            .unwrap()
    };
    let there = corrected(&select(&target, &source), 2.2);
    let back = corrected(&select(&source, &target), -2.2);
    for (there, back) in there.into_iter().zip(back) {
        assert!(apart(there, back.inverse()) < 1e-9);
    }
}

#[test]
fn shifting_an_origin_changes_every_misprint() {
    let truth = Se2::new(3.0, -2.0, 0.9);
    let (target_shift, source_shift) = (Vector2::new(5.0, -3.0), Vector2::new(-4.0, 7.0));
    for (rotation, translation) in [
        (TagOnlyRotation::P3, TagOnlyTranslation::SignFixed),
        (TagOnlyRotation::P3, TagOnlyTranslation::AsPrinted),
        (TagOnlyRotation::AsPrinted, TagOnlyTranslation::Corrected),
        (TagOnlyRotation::AsPrinted, TagOnlyTranslation::AsPrinted),
    ] {
        let plain =
            tag_only(&tags(truth, Vector2::zeros(), Vector2::zeros()), rotation, translation);
        let moved = tag_only(&tags(truth, target_shift, source_shift), rotation, translation);
        let back = shift(-target_shift) * moved * shift(source_shift);
        assert!(apart(plain, back) > 0.5, "{rotation:?} {translation:?}: {}", apart(plain, back));
    }
}
