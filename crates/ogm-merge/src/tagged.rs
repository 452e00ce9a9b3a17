//! Two maps with their tags, by one of the recipes.

use ogm_core::{Outcome, Progress, Se2};

use crate::resolution::{at_resolution, coarser};
use crate::stop::Stop;
use crate::task::Task;
use crate::{MergeError, RfidParams, RobotMap, TagEvidence, TagMethod, recipes};

/// The answer of a recipe, and what led to it.
#[derive(Debug, Clone)]
pub struct TagReport {
    /// Metres a cell of the maps as they were aligned: the coarser of the two.
    pub resolution: f64,
    /// What the stages saw, as far as they were reached.
    pub evidence: TagEvidence,
    /// The transform that maps points of the source map into the target map, or why there is none.
    pub outcome: Outcome<Se2>,
}

/// Finds the transform that maps points of `source` into the frame of `target` by their tags.
///
/// Maps of different resolution are both brought to the coarser one for this. The report says
/// what every stage saw; its outcome is the transform, or a refusal with its reason.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled; a valid pair that holds too little
/// is a refused outcome.
pub fn align_by_tags(
    method: TagMethod,
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
    progress: &dyn Progress,
) -> Result<TagReport, MergeError> {
    let resolution = coarser(target.map, source.map);
    let target_map = at_resolution(target.map, resolution, &params.thresholds)?;
    let source_map = at_resolution(source.map, resolution, &params.thresholds)?;
    let target = RobotMap { map: &target_map, tags: target.tags };
    let source = RobotMap { map: &source_map, tags: source.tags };

    let recipe = match method {
        TagMethod::Rfid1 => recipes::tags_alone,
        TagMethod::Rfid1b => recipes::tags_least_squares,
        TagMethod::Rfid2 => recipes::tags_and_walls,
        TagMethod::Rfid3 => recipes::tags_walls_and_icp,
        TagMethod::TwoTags => recipes::two_tags_walls_and_icp,
        TagMethod::TagsIcp => recipes::tags_and_icp,
    };
    let mut evidence = TagEvidence::default();
    let task = Task { target: &target, source: &source, params, progress };
    let outcome = match recipe(&task, &mut evidence) {
        Ok(target_from_source) => Outcome::Found(target_from_source),
        Err(Stop::Refused(refusal)) => Outcome::Refused(refusal),
        Err(Stop::Error(error)) => return Err(error),
    };
    progress.report(1.0);
    Ok(TagReport { resolution, evidence, outcome })
}
