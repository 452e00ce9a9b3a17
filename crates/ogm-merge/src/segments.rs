//! Maps without tags, by wall segments and the Radon transform (Saeedi et al.).

use grid_merge::{FusionParams, Merged, PlacedMap};
use ogm_core::{OccupancyGrid, Outcome, Progress, Se2, Stage};
use radon_merge::{RadonMatch, RadonParams, find_transform};

use crate::MergeError;
use crate::resolution::{at_resolution, coarser};

/// A team's maps in the frame of the first.
#[derive(Debug, Clone)]
pub struct TeamMerge {
    /// How each of the other maps was aligned to the first.
    pub matches: Vec<RadonMatch>,
    /// The first map with all others that could be aligned.
    pub merged: Merged,
}

/// Finds the transform that maps points of `source` into the frame of `target`, without tags and
/// without a start.
///
/// Maps of different resolution are both brought to the coarser one for this.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled; maps that do not match are a refused outcome.
pub fn align_by_radon(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    params: &RadonParams,
    progress: &dyn Progress,
) -> Result<RadonMatch, MergeError> {
    let resolution = coarser(target, source);
    let target = at_resolution(target, resolution, &params.thresholds)?;
    let source = at_resolution(source, resolution, &params.thresholds)?;
    Ok(find_transform(&target, &source, params, progress)?)
}

/// Aligns every map of `others` to `first` and fuses them in its frame, as the paper does with
/// three: second to first, third to first, then all.
///
/// A map that was refused stays out; its match says why.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled.
pub fn merge_by_radon(
    first: &OccupancyGrid,
    others: &[&OccupancyGrid],
    params: &RadonParams,
    fusion: &FusionParams,
    progress: &dyn Progress,
) -> Result<TeamMerge, MergeError> {
    let mut matches = Vec::with_capacity(others.len());
    let mut placed = vec![PlacedMap::new(first, Se2::identity())];
    let share = |map: usize| 0.9 * map as f64 / others.len() as f64;
    for (map, &other) in others.iter().enumerate() {
        let part = Stage::new(progress, share(map), share(map + 1));
        let found = align_by_radon(first, other, params, &part)?;
        if let Outcome::Found(first_from_other) = found.outcome {
            placed.push(PlacedMap::new(other, first_from_other));
        }
        matches.push(found);
    }
    Ok(TeamMerge {
        matches,
        merged: grid_merge::merge(&placed, fusion, &Stage::new(progress, 0.9, 1.0))?,
    })
}
