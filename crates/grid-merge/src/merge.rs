//! Maps in known poses made one map.

use std::borrow::Cow;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Se2, Stage};

use crate::bilinear::warp_bilinear;
use crate::coarsen::coarsen_in_rows;
use crate::fuse::Fused;
use crate::gaps::{blur_everywhere, blur_free, mean_of_majority};
use crate::lattice::{Footprint, output_lattice};
use crate::mapping::{Layer, Source, Vacant};
use crate::{FusionError, FusionParams, GapTreatment, Interpolation, Mapping};

/// Shares of the work after which all maps are coarsened, and on the output's lattice.
const COARSENED: f64 = 0.1;
const RESAMPLED: f64 = 0.4;

/// A map and where it lies.
#[derive(Debug, Clone, Copy)]
pub struct PlacedMap<'a> {
    /// The map, in its own map frame.
    pub map: &'a OccupancyGrid,
    /// Its pose in the frame of the output.
    pub reference_from_map: Se2,
}

/// One map made of several.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// The fused map, in the reference frame, yaw 0.
    pub map: OccupancyGrid,
    /// Cells that one map calls occupied and another free, on the lattice of `map`.
    pub conflicts: Grid<bool>,
    /// How many cells of `conflicts` are set.
    pub conflict_count: usize,
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
    let lattice = lattice_of(maps, params)?;
    let coarsened = Stage::new(progress, 0.0, COARSENED);
    let prepared: Vec<_> = maps
        .iter()
        .enumerate()
        .map(|(index, placed)| {
            let stage = Stage::nth(&coarsened, index, maps.len());
            not_finer(index, placed.map, &lattice, params, &stage)
        })
        .collect::<Result<_, _>>()?;
    let sources: Vec<_> = maps
        .iter()
        .zip(&prepared)
        .map(|(placed, map)| source_of(map, placed.reference_from_map))
        .collect();
    let footprints: Vec<_> = sources
        .iter()
        .map(|source| source.footprint(&lattice, &params.mapping))
        .collect::<Result<_, _>>()?;
    let bounds = footprints
        .iter()
        .copied()
        .reduce(|bounds, footprint| bounds.union(&footprint))
        .ok_or(FusionError::NoMaps)?;

    // Refuses an output over the size limit before anything of its size exists.
    let mut fused = Fused::blank(bounds.size())?;
    let mut layers = Vec::with_capacity(sources.len());
    let resampled = Stage::new(progress, COARSENED, RESAMPLED);
    for (index, (source, footprint)) in sources.into_iter().zip(&footprints).enumerate() {
        let (column, row) = footprint.offset_in(&bounds);
        let stage = Stage::nth(&resampled, index, maps.len());
        let cells = resample(source, &lattice, footprint, params, &stage)?;
        layers.push(Layer { column, row, cells });
    }
    let rest = Stage::new(progress, RESAMPLED, 1.0);
    fused.fuse(&layers, params.fusion, &params.thresholds, &rest)?;
    progress.report(1.0);
    Ok(Merged {
        map: OccupancyGrid::new(bounds.frame(&lattice), blurred(fused.cells, params)),
        conflicts: fused.conflicts,
        conflict_count: fused.conflict_count,
        compared: fused.compared,
    })
}

/// `source` in the target frame, with yaw 0: the [`merge`] of one map.
///
/// With inverse mapping a cell of the result is known exactly where the source is known at its
/// centre. A source that has yaw 0 in the target frame is copied.
///
/// # Errors
/// Those of [`merge`].
pub fn transform_grid(
    source: &OccupancyGrid,
    target_from_source: &Se2,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<OccupancyGrid, FusionError> {
    let placed = PlacedMap { map: source, reference_from_map: *target_from_source };
    let lattice = lattice_of(&[placed], params)?;
    let map = not_finer(0, source, &lattice, params, &Stage::new(progress, 0.0, COARSENED))?;
    let moved = source_of(&map, *target_from_source);
    let footprint = moved.footprint(&lattice, &params.mapping)?;
    let resampled = Stage::new(progress, COARSENED, 1.0);
    let cells = resample(moved, &lattice, &footprint, params, &resampled)?.into_owned();
    progress.report(1.0);
    Ok(OccupancyGrid::new(footprint.frame(&lattice), blurred(cells, params)))
}

/// The output's lattice, once it is clear that all poses can be meant.
fn lattice_of(maps: &[PlacedMap<'_>], params: &FusionParams) -> Result<GridFrame, FusionError> {
    let first = maps.first().ok_or(FusionError::NoMaps)?;
    for (index, placed) in maps.iter().enumerate() {
        check_pose(index, &placed.reference_from_map)?;
    }
    let size = (first.map.width(), first.map.height());
    let pose = &first.reference_from_map;
    Ok(output_lattice(first.map.frame(), size, pose, params.resolution)?)
}

pub(crate) fn check_pose(map: usize, reference_from_map: &Se2) -> Result<(), FusionError> {
    reference_from_map.check_finite().map_err(|cause| FusionError::NonFinitePose { map, cause })
}

/// Forward mapping onto a finer lattice would leave more gaps than cells.
pub(crate) fn check_scatter(
    map: usize,
    frame: &GridFrame,
    lattice: &GridFrame,
    mapping: &Mapping,
) -> Result<(), FusionError> {
    let (have, output) = (frame.resolution(), lattice.resolution());
    let scatters = matches!(mapping, Mapping::Forward { .. });
    if scatters && have > output && !frame.same_resolution(lattice) {
        return Err(FusionError::TooCoarseToScatter { map, have, output });
    }
    Ok(())
}

/// The map, coarsened where it is finer than the lattice.
fn not_finer<'a>(
    index: usize,
    map: &'a OccupancyGrid,
    lattice: &GridFrame,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Cow<'a, OccupancyGrid>, FusionError> {
    progress.go_on(0.0)?;
    check_scatter(index, map.frame(), lattice, &params.mapping)?;
    let finer = map.frame().resolution() < lattice.resolution();
    if finer && !map.frame().same_resolution(lattice) {
        let coarse = coarsen_in_rows(map, lattice.resolution(), &params.thresholds, progress)?;
        return Ok(Cow::Owned(coarse));
    }
    Ok(Cow::Borrowed(map))
}

fn source_of(map: &OccupancyGrid, reference_from_map: Se2) -> Source<'_, Occupancy> {
    Source { cells: Cow::Borrowed(map.cells()), frame: *map.frame(), reference_from_map }
}

fn resample<'a>(
    source: Source<'a, Occupancy>,
    lattice: &GridFrame,
    footprint: &Footprint,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Cow<'a, Grid<Occupancy>>, FusionError> {
    progress.go_on(0.0)?;
    let bilinear = params.mapping == Mapping::Inverse(Interpolation::Bilinear);
    if bilinear && !footprint.whole_cells {
        let warped = warp_bilinear(
            &source.cells,
            &source.frame,
            &footprint.frame(lattice),
            footprint.size(),
            &source.reference_from_map,
            progress,
        )?;
        return Ok(Cow::Owned(warped));
    }
    let fill = |known: &[Occupancy]| mean_of_majority(known, &params.thresholds);
    let vacant = Vacant { value: Occupancy::UNKNOWN, fill };
    source.onto(lattice, footprint, &params.mapping, vacant, progress)
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
