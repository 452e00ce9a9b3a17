//! The recipes: each reads like the section of the paper that it implements.

use ogm_core::{OccupancyGrid, Refusal, Se2};
use rfid_loc::{
    AMBIGUOUS_ABOVE, QuadrantConfidence, SelectionParams, TagPair, TagRotation, anchor_on_all_tags,
    anchor_on_tag, common_tags, least_squares_transform, pair_rotation, quadrant, select_tags,
    select_two_tags, tag_only_transform, tag_rotation,
};

use crate::checks::{tags_agree, tags_confirm, walls_confirm_nearby};
use crate::refine::{from_tags, from_walls_or_tags};
use crate::stop::Stop;
use crate::task::Task;
use crate::{Anchor, RfidParams, TagEvidence, WallDirection};

/// Method #1: three common tags and nothing else (Tsardoulias et al., section 5.2).
pub(crate) fn tags_alone(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let tags = three_tags(task, seen)?;
    let target_from_source = tag_only_transform(&tags, &task.params.tag_only)?.into_result()?;
    borne_out(task, target_from_source, seen)
}

/// Method #1b: the rigid motion that brings the accepted tags together in the least-squares sense.
pub(crate) fn tags_least_squares(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let tags = three_tags(task, seen)?;
    let target_from_source = least_squares_transform(&tags, &task.params.rotation).into_result()?;
    borne_out(task, target_from_source, seen)
}

/// Method #2: the walls give the rotation up to a quarter turn, the tags say which quarter and
/// the surest tag gives the translation (Tsardoulias et al., sections 4.1 and 4.2).
pub(crate) fn tags_and_walls(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let tags = three_tags(task, seen)?;
    let by_tags = tag_rotation(&tags, &task.params.rotation).into_result()?;
    let target_from_source = turned_by_walls(task, &tags, by_tags, seen)?;
    borne_out(task, target_from_source, seen)
}

/// Method #3: method #2, then ICP on the walls of the common section (Tsardoulias et al.,
/// section 4.3).
pub(crate) fn tags_walls_and_icp(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let tags = three_tags(task, seen)?;
    let by_tags = tag_rotation(&tags, &task.params.rotation).into_result()?;
    let by_walls = turned_by_walls(task, &tags, by_tags, seen);
    from_walls_or_tags(task, by_walls, seen)
}

/// Method #3 from two tags: the direction from one to the other says which quarter turn
/// (Tsardoulias et al., section 6, future work).
pub(crate) fn two_tags_walls_and_icp(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let params = task.params;
    // The lever of two tags is half of their distance.
    let min_separation = params.selection.min_separation.max(2.0 * params.rotation.min_arm);
    let selection = SelectionParams { min_separation, ..params.selection };
    seen.common_tags = common_tags(task.target.tags, task.source.tags)?;
    let tags = select_two_tags(&seen.common_tags, &selection)?.into_result()?;
    tags_agree(params, seen)?;
    let by_tags = pair_rotation(&tags, &params.rotation).into_result()?;
    let by_walls = turned_by_walls(task, &tags, by_tags, seen);
    from_walls_or_tags(task, by_walls, seen)
}

/// Method #1b, then ICP (Tsardoulias et al., section 6, conclusions).
pub(crate) fn tags_and_icp(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    three_tags(task, seen)?;
    from_tags(task, seen)
}

/// Rotation by the walls, quadrant and translation by the tags.
fn turned_by_walls(
    task: &Task<'_>,
    tags: &[TagPair],
    by_tags: TagRotation,
    seen: &mut TagEvidence,
) -> Result<Se2, Stop> {
    let params = task.params;
    seen.tag_rotation = Some(by_tags);
    let target_walls = wall_direction(task.target.map, params)?;
    task.progress.go_on(0.2)?;
    let source_walls = wall_direction(task.source.map, params)?;
    task.progress.go_on(0.4)?;
    let by_walls = ogm_vector::wall_rotation(&target_walls.vector, &source_walls.vector);
    seen.walls = Some([target_walls, source_walls]);

    let agreed = quadrant(by_tags.angle, by_walls)?;
    seen.quadrant = Some(agreed);
    if agreed.confidence == QuadrantConfidence::Ambiguous {
        let (residual_rad, limit_rad) = (agreed.residual.abs(), AMBIGUOUS_ABOVE);
        return Err(Refusal::Ambiguous { residual_rad, limit_rad }.into());
    }
    let target_from_source = match (params.anchor, tags) {
        (Anchor::BestTag, [best, ..]) => anchor_on_tag(agreed.theta, best)?,
        _ => anchor_on_all_tags(agreed.theta, tags)?,
    };
    seen.unrefined_target_from_source = Some(target_from_source);
    Ok(target_from_source)
}

/// The answer of a method that does not refine, unless the tags or the walls speak against it.
fn borne_out(
    task: &Task<'_>,
    target_from_source: Se2,
    seen: &mut TagEvidence,
) -> Result<Se2, Stop> {
    seen.unrefined_target_from_source = Some(target_from_source);
    tags_confirm(target_from_source, task.params, seen)?;
    walls_confirm_nearby(task, target_from_source, seen)?;
    Ok(target_from_source)
}

/// The three common tags that are known best, if they are known well enough (section 4.2) and
/// all that are lie alike in both maps.
fn three_tags(task: &Task<'_>, seen: &mut TagEvidence) -> Result<[TagPair; 3], Stop> {
    seen.common_tags = common_tags(task.target.tags, task.source.tags)?;
    let tags = select_tags(&seen.common_tags, &task.params.selection)?.into_result()?;
    tags_agree(task.params, seen)?;
    Ok(tags)
}

/// The straight walls of a map and the direction of its building (section 4.1).
pub(crate) fn wall_direction(
    map: &OccupancyGrid,
    params: &RfidParams,
) -> Result<WallDirection, Refusal> {
    let lines = line_ransac::Params { classes: params.thresholds, ..params.lines.clone() };
    let extraction = line_ransac::extract_segments(map, &lines).into_result()?;
    let vector = ogm_vector::ogm_vector(&extraction.segments, &params.vector).into_result()?;
    Ok(WallDirection { extraction, vector })
}
