//! The recipes: each reads like the section of the paper that it implements.

use icp2d::{Termination, WallPoints};
use ogm_core::{OccupancyGrid, Progress, Refusal, Se2};
use rfid_loc::{
    AMBIGUOUS_ABOVE, QuadrantConfidence, TagPair, anchor_on_all_tags, anchor_on_best_tag,
    common_tags, least_squares_transform, quadrant, select_tags, tag_only_transform, tag_rotation,
};

use crate::stop::Stop;
use crate::verify::wall_agreement;
use crate::{Anchor, RfidParams, RobotMap, TagEvidence, WallDirection};

/// Method #1: three common tags and nothing else (Tsardoulias et al., section 5.2).
pub(crate) fn tags_alone(
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    seen: &mut TagEvidence,
    _progress: &dyn Progress,
) -> Result<Se2, Stop> {
    let tags = sure_tags(target, source, params, seen)?;
    Ok(tag_only_transform(&tags, &params.tag_only)?.into_result()?)
}

/// Method #1b: the rigid motion that brings the accepted tags together in the least-squares sense.
pub(crate) fn tags_least_squares(
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    seen: &mut TagEvidence,
    _progress: &dyn Progress,
) -> Result<Se2, Stop> {
    let tags = sure_tags(target, source, params, seen)?;
    Ok(least_squares_transform(&tags, &params.rotation).into_result()?)
}

/// Method #2: the walls give the rotation up to a quarter turn, the tags say which quarter and
/// the surest tag gives the translation (Tsardoulias et al., sections 4.1 and 4.2).
pub(crate) fn tags_and_walls(
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    seen: &mut TagEvidence,
    progress: &dyn Progress,
) -> Result<Se2, Stop> {
    let tags = sure_tags(target, source, params, seen)?;
    let by_tags = tag_rotation(&tags, &params.rotation).into_result()?;
    seen.tag_rotation = Some(by_tags);

    let target_walls = wall_direction(target.map, params)?;
    progress.go_on(0.2)?;
    let source_walls = wall_direction(source.map, params)?;
    progress.go_on(0.4)?;
    let by_walls = ogm_vector::wall_rotation(&target_walls.vector, &source_walls.vector);
    seen.walls = Some([target_walls, source_walls]);

    let agreed = quadrant(by_tags.angle, by_walls)?;
    seen.quadrant = Some(agreed);
    if agreed.confidence == QuadrantConfidence::Ambiguous {
        let (residual_rad, limit_rad) = (agreed.residual.abs(), AMBIGUOUS_ABOVE);
        return Err(Refusal::Ambiguous { residual_rad, limit_rad }.into());
    }
    let target_from_source = match params.anchor {
        Anchor::BestTag => anchor_on_best_tag(agreed.theta, &tags)?,
        Anchor::AllTags => anchor_on_all_tags(agreed.theta, &tags)?,
    };
    seen.unrefined_target_from_source = Some(target_from_source);
    Ok(target_from_source)
}

/// Method #3: method #2, then ICP on the walls of the common section (Tsardoulias et al.,
/// section 4.3).
pub(crate) fn tags_walls_and_icp(
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    seen: &mut TagEvidence,
    progress: &dyn Progress,
) -> Result<Se2, Stop> {
    let start_target_from_source = tags_and_walls(target, source, params, seen, progress)?;
    let target_points = WallPoints::from_grid(target.map, &params.thresholds)?;
    let source_points = WallPoints::from_grid(source.map, &params.thresholds)?;
    let start_target_from_source = match &params.start {
        Some(search) => {
            icp2d::search_start(&target_points, &source_points, start_target_from_source, search)?
                .into_result()?
        }
        None => start_target_from_source,
    };
    seen.start_target_from_source = Some(start_target_from_source);
    progress.go_on(0.7)?;
    let alignment =
        icp2d::align(&target_points, &source_points, start_target_from_source, &params.icp)?
            .into_result()?;
    let target_from_source = alignment.target_from_source;
    seen.refinement = Some(alignment);
    // A fit that the iterations could not improve on is still the best there is; one that left the
    // surroundings of its start is none.
    if let Termination::MovedTooFar { .. } = alignment.termination {
        let (iterations, rmse_m) = (alignment.iterations, alignment.rmse);
        return Err(Refusal::NotConverged { iterations, rmse_m }.into());
    }
    let agreement = wall_agreement(target.map, source.map, target_from_source, &params.thresholds);
    seen.wall_agreement = Some(agreement);
    if agreement.share().is_none_or(|share| share < params.min_wall_agreement) {
        let conflicts = agreement.compared - agreement.agreeing;
        return Err(Refusal::Contradiction { conflicts, compared: agreement.compared }.into());
    }
    Ok(target_from_source)
}

/// The three common tags that are known best, if they are known well enough (section 4.2).
fn sure_tags(
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    seen: &mut TagEvidence,
) -> Result<[TagPair; 3], Stop> {
    seen.common_tags = common_tags(target.tags, source.tags)?;
    Ok(select_tags(&seen.common_tags, &params.selection)?.into_result()?)
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
