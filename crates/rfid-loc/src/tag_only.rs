//! The transform from three tags and nothing else (section 5.2, method #1).

use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, Refusal, Se2, wrap_angle};

use crate::filter::check_position;
use crate::rotation::{centroids, midpoints, rotation_towards};
use crate::selection::positions;
use crate::{
    RotationCentre, TagError, TagFrame, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation, TagPair,
};

/// Shorter levers give no direction at all, metres.
const NO_LEVER: f64 = 1e-9;

/// The `target_from_source` that three tags give on their own: the rotation of Eqs. 5 and 6, and
/// the centroids laid onto each other (Tsardoulias et al., section 5.2, Eq. 17).
///
/// The default is the corrected form, which does not depend on where the maps have their origins.
/// The printed forms do; they are evaluated in [`TagOnlyParams::frame`] and the result is converted
/// back, so that it maps source to target map frame whatever the options. Refuses as
/// [`tag_rotation`](crate::tag_rotation) does.
///
/// # Errors
/// A corner or centre that is not finite.
pub fn tag_only_transform(
    tags: &[TagPair; 3],
    params: &TagOnlyParams,
) -> Result<Outcome<Se2>, TagError> {
    let corners = corners(params.frame)?;
    let (target_centroid, source_centroid) = centroids(tags);
    let centre = match params.centre {
        RotationCentre::Origin => corners.source,
        RotationCentre::At(point) => {
            check_position(point)?;
            point
        }
        RotationCentre::TagCentroid => source_centroid,
    };
    let theta = match rotation(tags, params, corners) {
        Ok(theta) => theta,
        Err(refusal) => return Ok(Outcome::Refused(refusal)),
    };
    // From here on in the coordinates of the frame, counted from its corners.
    let (target_centroid, source_centroid) =
        (target_centroid - corners.target, source_centroid - corners.source);
    let centre = Point2::from(centre - corners.source);
    let turned = Se2::about(centre, theta, Vector2::zeros());
    let translation = match params.translation {
        TagOnlyTranslation::Corrected => {
            target_centroid - (turned * Point2::from(source_centroid)).coords
        }
        TagOnlyTranslation::SignFixed => target_centroid - source_centroid,
        TagOnlyTranslation::AsPrinted => source_centroid - target_centroid,
    };
    let shifted = |by: Vector2<f64>| Se2::new(by.x, by.y, 0.0);
    let map_from_frame = shifted(corners.target.coords);
    let frame_from_map = shifted(-corners.source.coords);
    let target_from_source = map_from_frame * shifted(translation) * turned * frame_from_map;
    Ok(Outcome::Found(target_from_source))
}

/// The origins of the frame's coordinates in the map frames.
#[derive(Debug, Clone, Copy)]
struct Corners {
    target: Point2<f64>,
    source: Point2<f64>,
}

fn corners(frame: TagFrame) -> Result<Corners, TagError> {
    let (target, source) = match frame {
        TagFrame::StartPose => (Point2::origin(), Point2::origin()),
        TagFrame::Cropped { target_corner, source_corner } => (target_corner, source_corner),
    };
    check_position(target)?;
    check_position(source)?;
    Ok(Corners { target, source })
}

fn rotation(tags: &[TagPair; 3], params: &TagOnlyParams, corners: Corners) -> Result<f64, Refusal> {
    let towards = |tag| rotation_towards(tag, tags, &params.levers).map(|found| found.angle);
    match params.rotation {
        TagOnlyRotation::P3 => towards(&tags[2]),
        TagOnlyRotation::P2 => towards(&tags[1]),
        TagOnlyRotation::AsPrinted => {
            let (target_tag, source_tag) = positions(&tags[1]);
            let (target_middle, source_middle) = midpoints(tags);
            let target = printed_direction(target_tag, target_middle, corners.target)?;
            let source = printed_direction(source_tag, source_middle, corners.source)?;
            Ok(wrap_angle(target - source))
        }
    }
}

/// arctan(y₂ − y_c, x₂ − y_c), with y_c where x_c is meant.
fn printed_direction(
    tag: Point2<f64>,
    middle: Point2<f64>,
    corner: Point2<f64>,
) -> Result<f64, Refusal> {
    let (tag, middle) = (tag - corner, middle - corner);
    let (rise, run) = (tag.y - middle.y, tag.x - middle.y);
    let lever = rise.hypot(run);
    if lever < NO_LEVER {
        return Err(Refusal::TagsCoincide { spread_m: lever, need_m: NO_LEVER });
    }
    Ok(rise.atan2(run))
}

#[cfg(test)]
mod tests {
    use super::tag_only_transform;
    use crate::RotationCentre::{At, Origin, TagCentroid};
    use crate::fixture::moved_pairs;
    use crate::{
        RotationCentre, TagError, TagFrame, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation,
        TagPair,
    };
    use nalgebra::{Point2, Vector2};
    use ogm_core::{Refusal, Se2};

    const SOURCES: [[f64; 2]; 3] = [[120.0, 80.0], [210.0, 40.0], [60.0, 190.0]];

    fn truth() -> Se2 {
        Se2::new(60.0, -35.0, 50_f64.to_radians())
    }

    fn found(tags: &[TagPair; 3], params: &TagOnlyParams) -> Se2 {
        tag_only_transform(tags, params).unwrap().found().unwrap()
    }

    fn degrees(rotation: TagOnlyRotation) -> f64 {
        let params = TagOnlyParams { rotation, ..TagOnlyParams::default() };
        found(&moved_pairs(truth(), SOURCES), &params).theta().to_degrees()
    }

    /// What every point is displaced by, the rotation being right.
    fn displacement(translation: TagOnlyTranslation, centre: RotationCentre) -> Vector2<f64> {
        let params = TagOnlyParams { translation, centre, ..TagOnlyParams::default() };
        let target_from_source = found(&moved_pairs(truth(), SOURCES), &params);
        let [here, there] = [Point2::new(-7.0, 300.0), Point2::new(80.0, 2.0)]
            .map(|point| target_from_source * point - truth() * point);
        assert!((here - there).norm() < 1e-9, "{here} is not {there}");
        here
    }

    #[test]
    fn t_m1_each_misprint_displaces_the_map_by_what_it_must() {
        assert!((degrees(TagOnlyRotation::P3) - 50.0).abs() < 1e-9);
        assert!((degrees(TagOnlyRotation::P2) - 50.0).abs() < 1e-9);
        assert!((degrees(TagOnlyRotation::AsPrinted) - 39.754788).abs() < 1e-6);

        let corrected = displacement(TagOnlyTranslation::Corrected, Origin);
        assert!(corrected.norm() < 1e-9, "{corrected}");
        let sign_fixed = displacement(TagOnlyTranslation::SignFixed, Origin);
        assert!((sign_fixed - Vector2::new(-125.5955, 62.6738)).norm() < 1e-4, "{sign_fixed}");
        assert!((sign_fixed.norm_squared() - 19702.25).abs() < 0.01);
        let printed = displacement(TagOnlyTranslation::AsPrinted, Origin);
        assert!((printed - Vector2::new(5.5955, 7.3262)).norm() < 1e-4, "{printed}");
        assert!((printed.norm_squared() - 84.98).abs() < 0.01);
    }

    #[test]
    fn about_the_centroid_of_the_tags_the_unrotated_difference_is_exact() {
        let offset = displacement(TagOnlyTranslation::SignFixed, TagCentroid);
        assert!(offset.norm() < 1e-9, "{offset}");
        let offset = displacement(TagOnlyTranslation::Corrected, At(Point2::new(350.0, 300.0)));
        assert!(offset.norm() < 1e-9, "{offset}");
    }

    #[test]
    fn about_an_image_centre_the_unrotated_difference_misses_by_the_turned_lever() {
        let centroid = Point2::new(130.0, 310.0 / 3.0);
        let lever = Vector2::new(-40.0, 25.0);
        let offset = displacement(TagOnlyTranslation::SignFixed, At(centroid - lever));
        let expected = truth() * lever - lever;
        assert!((offset - expected).norm() < 1e-9, "{offset} is not {expected}");
    }

    #[test]
    fn a_crop_changes_the_literal_forms_and_not_the_corrected_one() {
        let tags = moved_pairs(truth(), SOURCES);
        let cropped = TagFrame::Cropped {
            target_corner: Point2::new(-200.0, -90.0),
            source_corner: Point2::new(-150.0, -310.0),
        };
        let moves = |params: TagOnlyParams| {
            let in_crop = TagOnlyParams { frame: cropped, ..params };
            let probe = Point2::new(10.0, 20.0);
            (found(&tags, &params) * probe - found(&tags, &in_crop) * probe).norm()
        };
        let corrected = TagOnlyParams::default();
        assert!(moves(corrected) < 1e-9);
        // About one and the same place, the corners cancel.
        let sign_fixed = TagOnlyTranslation::SignFixed;
        let about_a_place = TagOnlyParams {
            translation: sign_fixed,
            centre: At(Point2::new(200.0, -10.0)),
            ..corrected
        };
        assert!(moves(about_a_place) < 1e-9);
        for literal in [
            TagOnlyParams { rotation: TagOnlyRotation::AsPrinted, ..corrected },
            TagOnlyParams { translation: TagOnlyTranslation::SignFixed, ..corrected },
            TagOnlyParams { translation: TagOnlyTranslation::AsPrinted, ..corrected },
        ] {
            assert!(moves(literal) > 10.0, "{literal:?}");
        }
    }

    #[test]
    fn tags_without_a_lever_are_refused_and_a_corner_that_is_not_finite_is_an_error() {
        let same = moved_pairs(truth(), [[5.0, 5.0]; 3]);
        for rotation in [TagOnlyRotation::P3, TagOnlyRotation::P2] {
            let params = TagOnlyParams { rotation, ..TagOnlyParams::default() };
            let outcome = tag_only_transform(&same, &params).unwrap();
            assert!(matches!(outcome.refusal(), Some(Refusal::TagsCoincide { .. })));
        }
        // Where x₂ = y₂ = y_c the printed direction does not exist.
        let printed =
            TagOnlyParams { rotation: TagOnlyRotation::AsPrinted, ..TagOnlyParams::default() };
        let outcome = tag_only_transform(&same, &printed).unwrap();
        assert!(matches!(outcome.refusal(), Some(Refusal::TagsCoincide { .. })));

        let nowhere =
            TagOnlyParams { centre: At(Point2::new(f64::NAN, 0.0)), ..TagOnlyParams::default() };
        let error = tag_only_transform(&same, &nowhere).unwrap_err();
        assert!(matches!(error, TagError::Position { .. }));
    }
}
