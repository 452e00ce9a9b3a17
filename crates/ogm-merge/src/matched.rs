//! Any two maps: matched without tags, then fused.

use grid_match::{MatchParams, MatchReport, match_maps};
use grid_merge::Merged;
use ogm_core::OccupancyGrid;

use crate::MergeError;
use crate::align::fuse_pair;

/// Finds the transform between two maps from the maps alone and fuses them in the frame of
/// `target` at its resolution; the maps may differ in resolution.
///
/// Nothing is fused where the outcome of the match is a refusal.
///
/// # Errors
/// Input that cannot be meant.
pub fn merge_matched(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    matching: &MatchParams,
    fusion: &grid_merge::FusionParams,
) -> Result<(MatchReport, Option<Merged>), MergeError> {
    let report = match_maps(target, source, matching, &())?;
    let merged = fuse_pair(target, source, &report.outcome, fusion)?;
    Ok((report, merged))
}

#[cfg(test)]
mod tests {
    use super::merge_matched;
    use grid_match::MatchParams;
    use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, simulate_pair};

    fn world(seed: u64) -> PairParams {
        PairParams {
            seed,
            step: 0.06,
            lidar: LidarParams { beams: 181, ..LidarParams::rf() },
            mapping: MappingParams { resolution: 0.1, ..MappingParams::default() },
            ..PairParams::default()
        }
    }

    #[test]
    fn maps_of_one_floor_are_fused_and_those_of_two_are_not() {
        let here = simulate_pair(&FloorPlan::random(3).unwrap(), &world(3)).unwrap();
        let there = simulate_pair(&FloorPlan::random(4).unwrap(), &world(4)).unwrap();
        let fusion = grid_merge::FusionParams::default();
        let merge = |source| {
            merge_matched(&here.target.map, source, &MatchParams::default(), &fusion).unwrap()
        };
        let (report, merged) = merge(&here.source.map);
        let target_from_source = report.outcome.found().unwrap();
        let error = here.target_from_source.between(&target_from_source);
        assert!(error.translation().norm() < 0.1, "{error:?}");
        assert!(merged.unwrap().compared > 0);
        let (report, merged) = merge(&there.source.map);
        assert!(report.outcome.refusal().is_some() && merged.is_none());
    }
}
