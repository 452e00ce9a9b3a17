//! Maps whose poses are known: nothing is searched, everything is checked.

use nalgebra::Matrix3;
use ogm_core::{Progress, Se2, Stage};

use crate::{AlignParams, Component, Member, MergeError, Method, PairReport, RobotMap, align_pair};

/// Maps in poses that are known, and what the maps say about those.
#[derive(Debug, Clone)]
pub struct KnownPoses {
    /// All maps, in the frame that their poses were given in.
    pub component: Component,
    /// Of each map but the first, in order, how it lies on the one before it that it overlaps most.
    pub pairs: Vec<KnownPair>,
}

/// How a map lies on an earlier one.
#[derive(Debug, Clone)]
pub struct KnownPair {
    /// The earlier map, by its place.
    pub target: usize,
    /// The map.
    pub source: usize,
    /// By [`Method::Known`]; its outcome is the pose that was given.
    pub report: PairReport,
}

/// Takes `maps` to lie where `reference_from_maps`, one for each, says, and looks at what they say
/// about it: overlap, agreement, and a warning where they say nothing or speak against it.
///
/// # Errors
/// No map, poses that are not finite or not as many as maps, or a call that was cancelled.
pub fn known_poses(
    maps: &[RobotMap<'_>],
    reference_from_maps: &[Se2],
    params: &AlignParams,
    progress: &dyn Progress,
) -> Result<KnownPoses, MergeError> {
    if maps.is_empty() || maps.len() != reference_from_maps.len() {
        let (poses, maps) = (reference_from_maps.len(), maps.len());
        return Err(MergeError::PosesOfMaps { poses, maps });
    }
    let mut pairs = Vec::new();
    let count = maps.len() * (maps.len() - 1) / 2;
    let mut done = 0..count;
    for source in 1..maps.len() {
        let mut best: Option<KnownPair> = None;
        for target in 0..source {
            let target_from_source =
                reference_from_maps[target].inverse() * reference_from_maps[source];
            let prior =
                Some(grid_match::Prior { target_from_source, sigma_m: 0.0, sigma_rad: 0.0 });
            let params = AlignParams { prior, ..params.clone() };
            let (of_target, of_source) = (&maps[target], &maps[source]);
            let stage = Stage::nth(progress, done.next().unwrap_or(count), count);
            let report = align_pair(Method::Known, of_target, of_source, &params, &stage)?;
            if best.as_ref().is_none_or(|best| report.overlap > best.report.overlap) {
                best = Some(KnownPair { target, source, report });
            }
        }
        pairs.extend(best);
    }
    progress.report(1.0);
    let member = |(map, &reference_from_map): (usize, &Se2)| Member {
        map,
        reference_from_map,
        covariance: Some(Matrix3::zeros()),
        bend_m: 0.0,
    };
    let members = reference_from_maps.iter().enumerate().map(member).collect();
    Ok(KnownPoses { component: Component { members }, pairs })
}
