//! From tags and a rotation to a transform (Eqs. 8, 9), and the rigid fit of tags alone.

use nalgebra::Point2;
use ogm_core::{Outcome, Refusal, Se2};

use crate::filter::check_position;
use crate::quadrant::check_angle;
use crate::rotation::{centroids, least_squares_rotation};
use crate::selection::positions;
use crate::{RotationParams, TagError, TagPair};

/// The `target_from_source` that turns by `theta` radians and lays a tag of the source, in the
/// paper the most certain one, onto that of the target (Tsardoulias et al., Eqs. 8, 9).
///
/// # Errors
/// A rotation that is not finite.
pub fn anchor_on_tag(theta: f64, tag: &TagPair) -> Result<Se2, TagError> {
    check_angle(theta)?;
    let (target, source) = positions(tag);
    Ok(laid_onto(theta, target, source))
}

/// As [`anchor_on_tag`], with the centroid of all tags in place of one, which averages their
/// errors.
///
/// # Errors
/// A rotation that is not finite, or no tags.
pub fn anchor_on_all_tags(theta: f64, tags: &[TagPair]) -> Result<Se2, TagError> {
    check_angle(theta)?;
    let (target, source) = centroids(tags);
    check_position(target)?;
    Ok(laid_onto(theta, target, source))
}

/// The `target_from_source` with the least squared distance between the tags of any two or more
/// pairs (closed-form rigid fit).
///
/// Refuses with [`Refusal::TooFewTags`] for less than two pairs, with [`Refusal::TagsCoincide`] if
/// they lie within the shortest lever, and with [`Refusal::Ambiguous`] if the maps place them too
/// differently to fit at all.
pub fn least_squares_transform(tags: &[TagPair], params: &RotationParams) -> Outcome<Se2> {
    let have = tags.len();
    if have < 2 {
        return Outcome::Refused(Refusal::TooFewTags { have, need: 2 });
    }
    match least_squares_rotation(tags, params) {
        Ok(theta) => {
            let (target, source) = centroids(tags);
            Outcome::Found(laid_onto(theta, target, source))
        }
        Err(refusal) => Outcome::Refused(refusal),
    }
}

/// Root mean square distance of the tags of `pairs` from each other under a transform, metres; NaN
/// without pairs.
#[must_use]
pub fn tag_residual(pairs: &[TagPair], target_from_source: &Se2) -> f64 {
    let squares = pairs
        .iter()
        .map(positions)
        .map(|(target, source)| (*target_from_source * source - target).norm_squared());
    (squares.sum::<f64>() / pairs.len() as f64).sqrt()
}

/// The motion that turns by `theta` and lays `source` onto `target`.
fn laid_onto(theta: f64, target: Point2<f64>, source: Point2<f64>) -> Se2 {
    Se2::about(source, theta, target - source)
}

#[cfg(test)]
mod tests {
    use super::{anchor_on_all_tags, anchor_on_tag, least_squares_transform, tag_residual};
    use crate::fixture::{moved_pairs, pairs_at};
    use crate::{RotationParams, TagError};
    use nalgebra::Point2;
    use ogm_core::{Refusal, Se2, wrap_angle};
    use proptest::prelude::{prop_assert, proptest};
    use std::f64::consts::PI;

    #[test]
    fn t_q4_the_best_tag_carries_the_map() {
        let tags = pairs_at([
            ([310.0, 205.0], [120.0, 80.0]),
            ([250.0, 330.0], [248.3384, 132.4811]),
            ([400.0, 300.0], [209.4952, -15.4757]),
        ]);
        let target_from_source = anchor_on_tag(93.4_f64.to_radians(), &tags[0]).unwrap();
        let moved = target_from_source * Point2::new(200.0, 150.0);
        assert!((moved - Point2::new(235.378702, 280.707740)).norm() < 1e-6, "{moved}");
        let best = target_from_source * tags[0].source().position;
        assert!((best - tags[0].target().position).norm() < 1e-12);
    }

    #[test]
    fn the_residual_is_the_root_mean_square_of_what_is_left() {
        let tags = pairs_at([([0.3, 0.0], [0.0, 0.0]), ([2.0, 0.4], [2.0, 0.0])]);
        let residual = tag_residual(&tags, &Se2::identity());
        assert!((residual - (0.125_f64).sqrt()).abs() < 1e-12, "{residual}");
        let moved = moved_pairs(Se2::new(5.0, -3.0, 2.0), [[0.0, 1.0], [4.0, 2.0]]);
        assert!(tag_residual(&moved, &Se2::new(5.0, -3.0, 2.0)) < 1e-12);
        assert!(tag_residual(&[], &Se2::identity()).is_nan());
    }

    #[test]
    fn all_tags_share_what_one_would_carry_alone() {
        // The best tag is 3 cm off in the target.
        let tags = pairs_at([
            ([0.03, 0.0], [0.0, 0.0]),
            ([2.0, 0.0], [2.0, 0.0]),
            ([0.0, 2.0], [0.0, 2.0]),
        ]);
        let best = anchor_on_tag(0.0, &tags[0]).unwrap().x();
        let all = anchor_on_all_tags(0.0, &tags).unwrap().x();
        assert!((best - 0.03).abs() < 1e-12 && (all - 0.01).abs() < 1e-12);
    }

    #[test]
    fn a_rotation_that_is_not_finite_is_an_error() {
        let tags = moved_pairs(Se2::identity(), [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert!(matches!(anchor_on_tag(f64::NAN, &tags[0]), Err(TagError::Grid(_))));
        assert!(matches!(anchor_on_all_tags(f64::NAN, &tags), Err(TagError::Grid(_))));
        assert!(matches!(anchor_on_all_tags(0.0, &[]), Err(TagError::Position { .. })));
    }

    proptest! {
        #[test]
        fn exact_tags_give_the_exact_transform_and_swapping_its_inverse(
            x in -50.0_f64..50.0, y in -50.0_f64..50.0, theta in -PI..PI,
        ) {
            let target_from_source = Se2::new(x, y, theta);
            let places = [[1.0, 0.5], [4.0, -2.0], [-1.0, 3.0], [5.0, 5.0]];
            let forward = moved_pairs(target_from_source, places);
            let backward = moved_pairs(target_from_source.inverse(), places.map(|[x, y]| {
                let target = target_from_source * Point2::new(x, y);
                [target.x, target.y]
            }));
            let params = RotationParams::default();
            let there = least_squares_transform(&forward, &params).found().unwrap();
            let back = least_squares_transform(&backward, &params).found().unwrap();
            for found in [there, back.inverse()] {
                prop_assert!((found.translation() - target_from_source.translation()).norm() < 1e-9);
                prop_assert!(wrap_angle(found.theta() - theta).abs() < 1e-10);
            }
        }

        #[test]
        fn no_other_motion_fits_noisy_tags_better(
            noise in proptest::array::uniform6(-0.1_f64..0.1),
            twist in proptest::array::uniform3(-0.05_f64..0.05),
        ) {
            let [a, b, c, d, e, f] = noise;
            let tags = pairs_at([
                ([a, b], [0.0, 0.0]), ([2.0 + c, d], [2.0, 0.0]), ([e, 3.0 + f], [0.0, 3.0]),
            ]);
            let misfit = |target_from_source: Se2| -> f64 {
                tags.iter()
                    .map(|tag| target_from_source * tag.source().position - tag.target().position)
                    .map(|offset| offset.norm_squared())
                    .sum()
            };
            let best = least_squares_transform(&tags, &RotationParams::default()).found().unwrap();
            let [x, y, theta] = twist;
            prop_assert!(misfit(best) <= misfit(Se2::new(x, y, theta) * best) + 1e-12);
        }
    }

    #[test]
    fn mirrored_tags_whose_turns_cancel_are_refused() {
        let height = 0.75_f64.sqrt();
        let tags =
            pairs_at([[1.0, 0.0], [-0.5, height], [-0.5, -height]].map(|[x, y]| ([x, -y], [x, y])));
        let outcome = least_squares_transform(&tags, &RotationParams::default());
        let refusal = outcome.refusal();
        assert!(matches!(refusal, Some(Refusal::Ambiguous { .. })), "{outcome:?}");
    }

    #[test]
    fn one_tag_fixes_no_rotation() {
        let tags = moved_pairs(Se2::identity(), [[1.0, 1.0]]);
        let outcome = least_squares_transform(&tags, &RotationParams::default());
        let too_few = Refusal::TooFewTags { have: 1, need: 2 };
        assert_eq!(outcome.refusal(), Some(&too_few));
    }
}
