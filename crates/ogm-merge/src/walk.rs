//! The recipe of Carpin and Birk: two maps and a rough start, no tags.

use carpin_walk::{Alignment, RandomWalk};
use ogm_core::{OccupancyGrid, Outcome, Progress, Se2};

use crate::MergeError;
use crate::resolution::{at_resolution, coarser};

/// Parameters of [`align_carpin`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CarpinParams {
    /// How the walk moves.
    pub rules: RandomWalk,
    /// How maps are compared, and for how long.
    pub search: carpin_walk::Params,
    /// Cells are at least this large for the walk, metres: 0, the maps' own. Larger ones cost less
    /// and take the walk further, since it moves by cells.
    pub min_resolution: f64,
}

/// The answer of the random walk, and what led to it.
#[derive(Debug, Clone, PartialEq)]
pub struct CarpinReport {
    /// Metres a cell of the maps as they were compared: the coarser of the two, or the least.
    pub resolution: f64,
    /// Where the walk began.
    pub start_target_from_source: Se2,
    /// The transform that maps points of the source map into the target map, with the trace of the
    /// walk, or why there is none.
    pub outcome: Outcome<Alignment>,
}

/// Finds the transform that maps points of `source` into the frame of `target` by a random walk
/// from a rough start (Carpin and Birk, *Stochastic map merging in rescue environments*).
///
/// Maps of different resolution are both brought to the coarser one for this, and to the least of
/// `params` if that is coarser. It never says that two maps do not match: a walk always ends
/// somewhere.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled; a valid pair that holds too little is a refused outcome.
pub fn align_carpin(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    start_target_from_source: Se2,
    params: &CarpinParams,
    progress: &dyn Progress,
) -> Result<CarpinReport, MergeError> {
    let resolution = coarser(target, source).max(params.min_resolution);
    let thresholds = &params.search.distance.thresholds;
    let target = at_resolution(target, resolution, thresholds)?;
    let source = at_resolution(source, resolution, thresholds)?;
    let start = start_target_from_source;
    let outcome =
        carpin_walk::align(&target, &source, start, &params.rules, &params.search, progress)?;
    Ok(CarpinReport { resolution, start_target_from_source, outcome })
}

#[cfg(test)]
mod tests {
    use super::{CarpinParams, align_carpin};
    use nalgebra::{Point2, Vector2};
    use ogm_core::{Refusal, Se2};
    use ogm_sim::{FloorPlan, PairParams, survey};

    #[test]
    fn maps_of_two_resolutions_meet_at_the_coarser_or_the_least() {
        let plan = FloorPlan::plan_a();
        let run = |seed, resolution, heading| {
            let mut robots = PairParams { seed, ..PairParams::cb() };
            robots.mapping.resolution = resolution;
            survey(&plan, heading, &robots).unwrap()
        };
        let (target, source) = (run(1, 0.28, 0.0), run(2, 0.14, 0.3));
        let truth = target.world_from_map.between(&source.world_from_map);
        let centre = Point2::new(7.0, 6.0);
        let start = Se2::about(centre, 0.1, Vector2::new(1.0, -1.0)) * truth;
        for (min_resolution, resolution) in [(0.0, 0.28), (0.35, 0.35)] {
            let params = CarpinParams { min_resolution, ..CarpinParams::default() };
            let report = align_carpin(&target.map, &source.map, start, &params, &()).unwrap();
            assert_eq!(report.resolution, resolution);
            let found = report.outcome.found().unwrap().target_from_source;
            let error = (found * (truth.inverse() * centre) - centre).norm();
            assert!(error < 0.28, "{error} m from a start 1.4 m off");
        }
    }

    #[test]
    fn a_map_of_nothing_is_refused() {
        let frame = ogm_core::GridFrame::new(0.14, Se2::identity()).unwrap();
        let map = ogm_core::OccupancyGrid::from_ascii(frame, "???\n???").unwrap();
        let report =
            align_carpin(&map, &map, Se2::identity(), &CarpinParams::default(), &()).unwrap();
        let expected = Refusal::TooLittleStructure { have: 0, need: 1 };
        assert_eq!(report.outcome.refusal(), Some(&expected));
    }
}
