//! How far the tags say that the source map is turned (Eqs. 5, 6).

use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, wrap_angle};

use crate::selection::positions;
use crate::{RotationParams, TagPair};

/// Where the cosine of the tags' mean disagreement is below this, they give no rotation: 60°.
const LEAST_AGREEMENT: f64 = 0.5;

/// The rotation that tags give on their own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagRotation {
    /// Rotation of target-from-source in [−π, π), radians.
    pub angle: f64,
    /// How it was found.
    pub rule: RotationRule,
    /// Whether the distances between the tags differ between the maps by more than tolerated: one
    /// of them is probably misplaced, or was moved.
    pub mismatch: bool,
}

/// How a rotation was read from tags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationRule {
    /// The direction from the midpoint of the two best tags to the third (Eqs. 5, 6).
    Midpoint,
    /// Least squares over all tags: of two, or where the third lies too near the midpoint of the
    /// others.
    LeastSquares,
}

/// The rotation of target-from-source that three tags give (Tsardoulias et al., Eqs. 5, 6).
///
/// Tags in one line are no problem; a third tag near the midpoint of the two best is, and the
/// least-squares rotation stands in. Refuses with [`Refusal::TagsCoincide`] if all tags lie
/// together, with [`Refusal::Ambiguous`] if the maps place them too differently to fit at all.
pub fn tag_rotation(tags: &[TagPair; 3], params: &RotationParams) -> Outcome<TagRotation> {
    rotation_towards(&tags[2], tags, params).into()
}

/// The rotation of target-from-source that two tags give: that of the direction from one to the
/// other (Tsardoulias et al., section 6, future work).
///
/// Refuses as [`tag_rotation`] does; the shortest lever is half of their distance.
pub fn pair_rotation(tags: &[TagPair; 2], params: &RotationParams) -> Outcome<TagRotation> {
    let rotation = least_squares_rotation(tags, params).map(|angle| TagRotation {
        angle,
        rule: RotationRule::LeastSquares,
        mismatch: distances_differ(tags, params),
    });
    rotation.into()
}

/// The rotation from the direction of `tag` seen from the midpoint of the two best.
pub(crate) fn rotation_towards(
    tag: &TagPair,
    tags: &[TagPair; 3],
    params: &RotationParams,
) -> Result<TagRotation, Refusal> {
    let (target_tag, source_tag) = positions(tag);
    let (target_middle, source_middle) = midpoints(tags);
    let (target_arm, source_arm) = (target_tag - target_middle, source_tag - source_middle);
    let shorter = target_arm.norm().min(source_arm.norm());
    let (angle, rule) = if shorter >= params.min_arm && shorter > 0.0 {
        let angle = direction(target_arm) - direction(source_arm);
        (wrap_angle(angle), RotationRule::Midpoint)
    } else {
        (least_squares_rotation(tags, params)?, RotationRule::LeastSquares)
    };
    Ok(TagRotation { angle, rule, mismatch: distances_differ(tags, params) })
}

/// The midpoints of the two best tags in target and source (Eq. 5).
pub(crate) fn midpoints(tags: &[TagPair; 3]) -> (Point2<f64>, Point2<f64>) {
    centroids(&tags[..2])
}

/// The centroids of the tags in target and source; NaN without tags.
pub(crate) fn centroids(tags: &[TagPair]) -> (Point2<f64>, Point2<f64>) {
    let mut sums = (Vector2::zeros(), Vector2::zeros());
    for (target, source) in tags.iter().map(positions) {
        sums.0 += target.coords;
        sums.1 += source.coords;
    }
    let count = tags.len() as f64;
    (Point2::from(sums.0 / count), Point2::from(sums.1 / count))
}

/// The rotation that fits at least two tags best.
pub(crate) fn least_squares_rotation(
    tags: &[TagPair],
    params: &RotationParams,
) -> Result<f64, Refusal> {
    let (target_centre, source_centre) = centroids(tags);
    let (mut cross, mut dot) = (0.0, 0.0);
    let (mut target_sq, mut source_sq) = (0.0, 0.0);
    let (mut target_spread, mut source_spread) = (0.0_f64, 0.0_f64);
    for (target, source) in tags.iter().map(positions) {
        let (a, b) = (target - target_centre, source - source_centre);
        cross += b.perp(&a);
        dot += b.dot(&a);
        target_sq += a.norm_squared();
        source_sq += b.norm_squared();
        target_spread = target_spread.max(a.norm());
        source_spread = source_spread.max(b.norm());
    }
    let spread = target_spread.min(source_spread);
    if !(spread >= params.min_arm && spread > 0.0) {
        return Err(Refusal::TagsCoincide { spread_m: spread, need_m: params.min_arm });
    }
    let agreement = cross.hypot(dot) / (target_sq * source_sq).sqrt();
    if agreement < LEAST_AGREEMENT {
        return Err(Refusal::Ambiguous {
            residual_rad: agreement.acos(),
            limit_rad: LEAST_AGREEMENT.acos(),
        });
    }
    Ok(wrap_angle(cross.atan2(dot)))
}

fn direction(arm: Vector2<f64>) -> f64 {
    arm.y.atan2(arm.x)
}

fn distances_differ(tags: &[TagPair], params: &RotationParams) -> bool {
    tags.iter().enumerate().any(|(index, a)| {
        tags[index + 1..].iter().any(|b| {
            let ((target_a, source_a), (target_b, source_b)) = (positions(a), positions(b));
            let (in_target, in_source) =
                ((target_a - target_b).norm(), (source_a - source_b).norm());
            let share = params.distance_tolerance_share * in_target.max(in_source);
            (in_target - in_source).abs() > params.distance_tolerance.max(share)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{RotationRule, pair_rotation, tag_rotation};
    use crate::RotationParams;
    use crate::fixture::{moved_pairs, pairs_at};
    use ogm_core::{Refusal, Se2};

    /// The defaults in pixels of 0.02 m.
    fn pixels() -> RotationParams {
        RotationParams { min_arm: 25.0, distance_tolerance: 5.0, ..RotationParams::default() }
    }

    #[test]
    fn t_q3_the_third_tag_turns_by_93_4_degrees() {
        let tags = pairs_at([
            ([310.0, 205.0], [120.0, 80.0]),
            ([250.0, 330.0], [248.3384, 132.4811]),
            ([400.0, 300.0], [209.4952, -15.4757]),
        ]);
        let (target, source) = super::midpoints(&tags);
        let theta_1 = super::direction(tags[2].target().position - target).to_degrees();
        let theta_2 = super::direction(tags[2].source().position - source).to_degrees();
        // The source positions are printed to 1e-4 px, 1e-4° at this distance.
        assert!((theta_1 - 15.154068).abs() < 1e-6, "{theta_1}");
        assert!((theta_2 + 78.245932).abs() < 1e-4, "{theta_2}");

        let rotation = tag_rotation(&tags, &pixels()).found().unwrap();
        assert!((rotation.angle.to_degrees() - 93.4).abs() < 1e-4);
        assert_eq!(rotation.rule, RotationRule::Midpoint);
        assert!(!rotation.mismatch);
    }

    #[test]
    fn a_rotation_is_wrapped_where_the_directions_are_not() {
        for degrees in [-179.0_f64, -100.0, 170.0, 179.9] {
            let target_from_source = Se2::new(1.0, 2.0, degrees.to_radians());
            let tags = moved_pairs(target_from_source, [[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]]);
            let rotation = tag_rotation(&tags, &RotationParams::default()).found().unwrap();
            assert!((rotation.angle.to_degrees() - degrees).abs() < 1e-9);
        }
    }

    #[test]
    fn tags_in_a_line_fix_a_rotation() {
        let target_from_source = Se2::new(3.0, -1.0, 2.0);
        let in_line = [[0.0, 0.0], [1.0, 0.5], [2.0, 1.0]];
        let tags = moved_pairs(target_from_source, in_line);
        let rotation = tag_rotation(&tags, &RotationParams::default()).found().unwrap();
        assert!((rotation.angle - 2.0).abs() < 1e-12);
        assert_eq!(rotation.rule, RotationRule::Midpoint);
    }

    #[test]
    fn a_third_tag_on_the_midpoint_falls_back_to_least_squares() {
        let target_from_source = Se2::new(3.0, -1.0, -2.5);
        let tags = moved_pairs(target_from_source, [[0.0, 0.0], [2.0, 1.0], [1.0, 0.5]]);
        let rotation = tag_rotation(&tags, &RotationParams::default()).found().unwrap();
        assert!((rotation.angle + 2.5).abs() < 1e-12);
        assert_eq!(rotation.rule, RotationRule::LeastSquares);
    }

    #[test]
    fn tags_in_one_place_are_refused() {
        let tags = moved_pairs(Se2::identity(), [[1.0, 1.0], [1.1, 1.0], [1.0, 1.2]]);
        let outcome = tag_rotation(&tags, &RotationParams::default());
        let Some(&Refusal::TagsCoincide { spread_m, need_m }) = outcome.refusal() else {
            panic!("{outcome:?}");
        };
        assert!(spread_m < need_m && need_m == 0.5);

        let no_minimum = RotationParams { min_arm: 0.0, ..RotationParams::default() };
        let same = moved_pairs(Se2::identity(), [[1.0, 1.0]; 3]);
        assert!(tag_rotation(&same, &no_minimum).refusal().is_some());
    }

    #[test]
    fn two_tags_turn_by_the_direction_between_them_and_are_checked_too() {
        let target_from_source = Se2::new(3.0, -1.0, -2.5);
        let tags = moved_pairs(target_from_source, [[0.0, 0.0], [2.0, 1.0]]);
        let rotation = pair_rotation(&tags, &RotationParams::default()).found().unwrap();
        assert!((rotation.angle + 2.5).abs() < 1e-12 && !rotation.mismatch);
        let stretched = pairs_at([([0.0, 0.0], [0.0, 0.0]), ([2.2, 0.0], [2.0, 0.0])]);
        assert!(pair_rotation(&stretched, &RotationParams::default()).found().unwrap().mismatch);
        let near = moved_pairs(target_from_source, [[0.0, 0.0], [0.9, 0.0]]);
        assert!(pair_rotation(&near, &RotationParams::default()).refusal().is_some());
    }

    #[test]
    fn each_of_three_distances_is_checked() {
        for moved in 0..3 {
            let mut places = [[0.0, 0.0], [4.0, 0.0], [2.0, 3.0]].map(|at| (at, at));
            // Along the side to the next tag, so that the other distance changes less.
            let next = places[(moved + 1) % 3].1;
            let here = places[moved].1;
            let away = 0.3 / f64::hypot(next[0] - here[0], next[1] - here[1]);
            places[moved].0 = [0, 1].map(|axis| here[axis] - away * (next[axis] - here[axis]));
            let tags = pairs_at(places);
            assert!(tag_rotation(&tags, &RotationParams::default()).found().unwrap().mismatch);
        }
    }

    #[test]
    fn a_moved_tag_is_flagged_beyond_the_tolerance_only() {
        for (offset, mismatch) in [(0.08, false), (0.12, true)] {
            let tags = pairs_at([
                ([0.0, 0.0], [0.0, 0.0]),
                ([1.0, 0.0], [1.0, 0.0]),
                ([0.0, 1.0 + offset], [0.0, 1.0]),
            ]);
            let rotation = tag_rotation(&tags, &RotationParams::default()).found().unwrap();
            assert_eq!(rotation.mismatch, mismatch, "{offset}");
        }
        // Far apart, the share of the distance counts.
        let tags = pairs_at([
            ([0.0, 0.0], [0.0, 0.0]),
            ([9.0, 0.0], [9.0, 0.0]),
            ([0.0, 10.4], [0.0, 10.0]),
        ]);
        assert!(!tag_rotation(&tags, &RotationParams::default()).found().unwrap().mismatch);
    }
}
