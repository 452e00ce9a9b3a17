//! The front door: two maps with their tags, and a method.

use std::borrow::Cow;

use grid_merge::{Merged, PlacedMap};
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Se2, TagEstimate};

use crate::stop::Stop;
use crate::{Evidence, MergeError, MergeParams, MergeReport, RfidParams, recipes};

/// A robot's map and the tags that it localised, in the same map frame.
#[derive(Debug, Clone, Copy)]
pub struct RobotMap<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The tags.
    pub tags: &'a [TagEstimate],
}

/// How to find the transform between two maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// #1: rotation and translation from three tags.
    Rfid1,
    /// #1b: least squares over the same tags; ours, as a baseline.
    Rfid1b,
    /// #2: rotation from the walls, quadrant and translation from the tags.
    Rfid2,
    /// #3: #2, refined by ICP.
    Rfid3,
}

/// Finds the transform that maps points of `source` into the frame of `target`.
///
/// Maps of different resolution are both brought to the coarser one for this. The report says
/// what every stage saw; its outcome is the transform, or a refusal with its reason.
///
/// # Errors
/// Input that cannot be meant; a valid pair that holds too little is a refused outcome.
pub fn align(
    method: Method,
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &RfidParams,
) -> Result<MergeReport, MergeError> {
    let resolution = target.map.frame().resolution().max(source.map.frame().resolution());
    let target_map = at_resolution(target.map, resolution, &params.thresholds)?;
    let source_map = at_resolution(source.map, resolution, &params.thresholds)?;
    let target = RobotMap { map: &target_map, tags: target.tags };
    let source = RobotMap { map: &source_map, tags: source.tags };

    let recipe = match method {
        Method::Rfid1 => recipes::tags_alone,
        Method::Rfid1b => recipes::tags_least_squares,
        Method::Rfid2 => recipes::tags_and_walls,
        Method::Rfid3 => recipes::tags_walls_and_icp,
    };
    let mut evidence = Evidence::default();
    let outcome = match recipe(&target, &source, params, &mut evidence) {
        Ok(target_from_source) => Outcome::Found(target_from_source),
        Err(Stop::Refused(refusal)) => Outcome::Refused(refusal),
        Err(Stop::Error(error)) => return Err(error),
    };
    Ok(MergeReport { method, resolution, evidence, outcome })
}

/// [`align`], and the two maps fused in the frame of `target` at its resolution.
///
/// Fused at the maps' own resolutions, whatever they were aligned at. Nothing is fused where the
/// outcome is a refusal.
///
/// # Errors
/// Input that cannot be meant.
pub fn merge(
    method: Method,
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &MergeParams,
) -> Result<(MergeReport, Option<Merged>), MergeError> {
    let report = align(method, target, source, &params.rfid)?;
    let merged = fuse_pair(target.map, source.map, &report.outcome, &params.fusion)?;
    Ok((report, merged))
}

/// Two maps in the frame of `target`, where a transform was found.
pub(crate) fn fuse_pair(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    outcome: &Outcome<Se2>,
    fusion: &grid_merge::FusionParams,
) -> Result<Option<Merged>, MergeError> {
    let Outcome::Found(target_from_source) = outcome else { return Ok(None) };
    let placed = [
        PlacedMap { map: target, reference_from_map: Se2::identity() },
        PlacedMap { map: source, reference_from_map: *target_from_source },
    ];
    Ok(Some(grid_merge::merge(&placed, fusion, &())?))
}

pub(crate) fn at_resolution<'a>(
    map: &'a OccupancyGrid,
    resolution: f64,
    thresholds: &ClassThresholds,
) -> Result<Cow<'a, OccupancyGrid>, MergeError> {
    if (map.frame().resolution() / resolution - 1.0).abs() <= 1e-6 {
        Ok(Cow::Borrowed(map))
    } else {
        Ok(Cow::Owned(grid_merge::coarsen(map, resolution, thresholds)?))
    }
}
