//! Whether an answer by tags is borne out by all tags, and by the walls.

use icp2d::{WallPoints, search_start};
use ogm_core::{Outcome, Refusal, Se2};
use rfid_loc::{TagPair, least_squares_transform, sure_tags, tag_residual};

use crate::stop::Stop;
use crate::task::Task;
use crate::verify::wall_agreement;
use crate::{RfidParams, TagEvidence};

/// Unknowns of a rigid motion.
const FITTED: f64 = 3.0;

/// Tags may lie apart under an answer by this many times what the best motion leaves between
/// them…
const WORSE: f64 = 4.0;

/// …or by this, metres: maps bend, and tags with them.
const BENT: f64 = 0.2;

/// Refuses where no rigid motion brings together what both maps know surely.
pub(crate) fn tags_agree(params: &RfidParams, seen: &mut TagEvidence) -> Result<(), Stop> {
    if params.max_tag_residual.is_infinite() {
        return Ok(());
    }
    let pairs = sure_tags(&seen.common_tags, &params.selection);
    let fit = least_squares_transform(pairs, &params.rotation).into_result()?;
    let coordinates = 2.0 * pairs.len() as f64;
    let residual = tag_residual(pairs, &fit) * (coordinates / (coordinates - FITTED)).sqrt();
    seen.tag_fit_residual = Some(residual);
    at_most(residual, params.max_tag_residual)
}

/// Refuses where tags that both maps know surely lie apart under the answer.
pub(crate) fn tags_confirm(
    target_from_source: Se2,
    params: &RfidParams,
    seen: &mut TagEvidence,
) -> Result<(), Stop> {
    let pairs: &[TagPair] = sure_tags(&seen.common_tags, &params.selection);
    let residual = tag_residual(pairs, &target_from_source);
    seen.tag_residual = Some(residual);
    let as_fitted = match seen.tag_fit_residual {
        Some(fitted) => BENT.max(WORSE * fitted),
        None => f64::INFINITY,
    };
    at_most(residual, params.max_tag_residual.min(as_fitted))
}

/// Refuses where the walls disagree under a refined answer.
pub(crate) fn walls_confirm(
    task: &Task<'_>,
    target_from_source: Se2,
    seen: &mut TagEvidence,
) -> Result<(), Stop> {
    let (target, source, params) = (task.target.map, task.source.map, task.params);
    let agreement = wall_agreement(target, source, target_from_source, &params.thresholds);
    seen.wall_agreement = Some(agreement);
    if params.min_wall_agreement <= 0.0
        || agreement.share().is_some_and(|share| share >= params.min_wall_agreement)
    {
        return Ok(());
    }
    let conflicts = agreement.compared - agreement.agreeing;
    Err(Refusal::Contradiction { conflicts, compared: agreement.compared }.into())
}

/// Refuses where the walls disagree all around an answer that is not refined.
pub(crate) fn walls_confirm_nearby(
    task: &Task<'_>,
    target_from_source: Se2,
    seen: &mut TagEvidence,
) -> Result<(), Stop> {
    let params = task.params;
    if params.min_wall_agreement <= 0.0 {
        return Ok(());
    }
    let target_points = WallPoints::from_grid(task.target.map, &params.thresholds)?;
    let source_points = WallPoints::from_grid(task.source.map, &params.thresholds)?;
    let around = params.start.unwrap_or_default();
    let near_target_from_source =
        match search_start(&target_points, &source_points, target_from_source, &around)? {
            Outcome::Found(near) => near,
            Outcome::Refused(_) => target_from_source,
        };
    walls_confirm(task, near_target_from_source, seen)
}

fn at_most(residual_m: f64, limit_m: f64) -> Result<(), Stop> {
    if residual_m <= limit_m {
        Ok(())
    } else {
        Err(Refusal::TagsDisagree { residual_m, limit_m }.into())
    }
}
