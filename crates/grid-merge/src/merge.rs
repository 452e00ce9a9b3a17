//! Maps in known poses made one map.

use ogm_core::{Grid, Occupancy, OccupancyGrid, Progress, Se2, Stage};

use crate::fuse::{Fused, Rule};
use crate::gaps::{blur_everywhere, blur_free};
use crate::lay::{Laid, lay};
use crate::mask::CellMask;
use crate::placed::PlacedMap;
use crate::regions::ConflictRegion;
use crate::{FusionError, FusionParams, GapTreatment, Mapping};

/// Share of the work after which every map can be read on the output's lattice.
const LAID: f64 = 0.4;

/// One map made of several.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// The fused map, in the reference frame, yaw 0.
    pub map: OccupancyGrid,
    /// Cells that one map calls occupied and another free, on the lattice of `map`; under
    /// [`FusionRule::KeepWalls`](crate::FusionRule::KeepWalls) those where the other has no such
    /// wall as near as the uncertainty of both allows.
    pub conflicts: CellMask,
    /// How many cells of `conflicts` are set.
    pub conflict_count: usize,
    /// The places that they form, largest first, at most a thousand.
    pub regions: Vec<ConflictRegion>,
    /// How many such places there are.
    pub region_count: usize,
    /// Cells that two maps or more know.
    pub compared: usize,
}

/// Fuses `maps` in the frame that their poses are given in.
///
/// The output is the bounding box of all maps, with yaw 0. Where the first map has yaw 0 in the
/// reference frame and no other resolution is asked for, its lattice is kept and its cells are
/// copied; so are those of every map that lies on that lattice. All others are resampled by
/// [`FusionParams::mapping`], those of finer resolution after [`coarsen`](crate::coarsen()). By Tsardoulias et al.,
/// section 4.4; there the second map is transformed and the first stays.
///
/// # Errors
/// No map, a pose that is not finite, an output over the size limit or of no usable resolution,
/// forward mapping of a map that is coarser than the output, and [`FusionError::Cancelled`].
pub fn merge(
    maps: &[PlacedMap<'_>],
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Merged, FusionError> {
    let Laid { lattice, bounds, reaches } = lay(maps, params, &Stage::new(progress, 0.0, LAID))?;
    let frame = bounds.frame(&lattice);
    let mut fused = Fused::blank(bounds.size())?;
    let rest = Stage::new(progress, LAID, 1.0);
    let rule = Rule::new(params.fusion, maps, frame, &params.thresholds);
    fused.fuse(&reaches, &rule, &rest)?;
    progress.report(1.0);
    let (regions, region_count) = fused.regions.finish(&frame);
    Ok(Merged {
        map: OccupancyGrid::new(frame, blurred(fused.cells, params)),
        conflict_count: fused.conflicts.count(),
        conflicts: fused.conflicts,
        regions,
        region_count,
        compared: fused.compared,
    })
}

/// `source` in the target frame, with yaw 0: the [`merge`] of one map.
///
/// With inverse mapping a cell of the result is known where the source is known at its centre and,
/// under a rule that keeps walls, where a wall's centre lands that no such cell shows. A source that
/// has yaw 0 in the target frame is copied.
///
/// # Errors
/// Those of [`merge`].
pub fn transform_grid(
    source: &OccupancyGrid,
    target_from_source: &Se2,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<OccupancyGrid, FusionError> {
    Ok(merge(&[PlacedMap::new(source, *target_from_source)], params, progress)?.map)
}

fn blurred(cells: Grid<Occupancy>, params: &FusionParams) -> Grid<Occupancy> {
    match params.mapping {
        Mapping::Forward { gaps: GapTreatment::BlurEverywhere, .. } => blur_everywhere(&cells),
        Mapping::Forward { gaps: GapTreatment::PrintedCondition, .. } => {
            blur_free(&cells, &params.thresholds)
        }
        _ => cells,
    }
}
