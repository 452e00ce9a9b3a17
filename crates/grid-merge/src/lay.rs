//! Maps laid on the lattice of the output.

use std::borrow::Cow;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Progress, Stage, cell_count};

use crate::bilinear::warp_bilinear;
use crate::coarsen::coarsen_in_rows;
use crate::gaps::mean_of_majority;
use crate::lattice::{Footprint, output_lattice};
use crate::mapping::{Source, Vacant};
use crate::placed::PlacedMap;
use crate::pose::{check_pose, check_scatter};
use crate::rows::{Reach, ReachCells, WarpedMap};
use crate::{FusionError, FusionParams, Interpolation, Mapping};

/// Share of the work after which all maps are coarsened.
const COARSENED: f64 = 0.25;

/// Maps that can be read row by row on one lattice.
pub(crate) struct Laid<'a> {
    pub(crate) lattice: GridFrame,
    pub(crate) bounds: Footprint,
    pub(crate) reaches: Vec<Reach<'a>>,
}

/// Lays `maps` on the lattice of the first. An output over the size limit is refused before
/// anything of its size exists.
pub(crate) fn lay<'a>(
    maps: &[PlacedMap<'a>],
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Laid<'a>, FusionError> {
    let lattice = lattice_of(maps, params)?;
    let coarsened = Stage::new(progress, 0.0, COARSENED);
    let sources: Vec<_> = maps
        .iter()
        .enumerate()
        .map(|(index, placed)| {
            let stage = Stage::nth(&coarsened, index, maps.len());
            let map = not_too_fine(index, placed.map, &lattice, params, &stage)?;
            let frame = *map.frame();
            let cells = match map {
                Cow::Borrowed(map) => Cow::Borrowed(map.cells()),
                Cow::Owned(map) => Cow::Owned(map.cells().clone()),
            };
            Ok(Source { cells, frame, reference_from_map: placed.reference_from_map })
        })
        .collect::<Result<_, FusionError>>()?;
    let footprints: Vec<_> = sources
        .iter()
        .map(|source| source.footprint(&lattice, &params.mapping))
        .collect::<Result<_, _>>()?;
    let bounds = footprints.iter().copied().reduce(|bounds, footprint| bounds.union(&footprint));
    let bounds = bounds.ok_or(FusionError::NoMaps)?;
    let (width, height) = bounds.size();
    cell_count(width, height)?;

    let resampled = Stage::new(progress, COARSENED, 1.0);
    let reaches = sources
        .into_iter()
        .zip(&footprints)
        .enumerate()
        .map(|(index, (source, footprint))| {
            let (column, row) = footprint.offset_in(&bounds);
            let (columns, rows) = footprint.size();
            let stage = Stage::nth(&resampled, index, maps.len());
            Ok(Reach {
                columns: column..column + columns,
                rows: row..row + rows,
                cells: seen_on(source, &lattice, footprint, params, &stage)?,
            })
        })
        .collect::<Result<_, FusionError>>()?;
    Ok(Laid { lattice, bounds, reaches })
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

/// The map, coarsened where it is finer than the lattice and the mapping does not see to that.
fn not_too_fine<'a>(
    index: usize,
    map: &'a OccupancyGrid,
    lattice: &GridFrame,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<Cow<'a, OccupancyGrid>, FusionError> {
    progress.go_on(0.0)?;
    check_scatter(index, map.frame(), lattice, &params.mapping)?;
    let finer = map.frame().resolution() < lattice.resolution();
    let gathers = params.mapping == Mapping::Inverse(Interpolation::Nearest);
    if finer && !gathers && !map.frame().same_resolution(lattice) {
        let coarse = coarsen_in_rows(map, lattice.resolution(), &params.thresholds, progress)?;
        return Ok(Cow::Owned(coarse));
    }
    Ok(Cow::Borrowed(map))
}

fn seen_on<'a>(
    source: Source<'a, Occupancy>,
    lattice: &GridFrame,
    footprint: &Footprint,
    params: &FusionParams,
    progress: &dyn Progress,
) -> Result<ReachCells<'a>, FusionError> {
    progress.go_on(0.0)?;
    if footprint.whole_cells {
        return Ok(ReachCells::Laid(source.cells));
    }
    let thresholds = params.thresholds;
    let frame = footprint.frame(lattice);
    match (params.mapping, &source.cells) {
        (Mapping::Inverse(Interpolation::Nearest), Cow::Borrowed(cells)) => {
            let pose = &source.reference_from_map;
            let map = WarpedMap::new(cells, &source.frame, &frame, pose, thresholds)?;
            Ok(ReachCells::Warped(Box::new(map)))
        }
        (Mapping::Inverse(Interpolation::Bilinear), cells) => {
            let (size, pose) = (footprint.size(), &source.reference_from_map);
            let warped = warp_bilinear(cells, &source.frame, &frame, size, pose, progress)?;
            Ok(ReachCells::Laid(Cow::Owned(warped)))
        }
        (mapping, _) => {
            let fill = |known: &[Occupancy]| mean_of_majority(known, &thresholds);
            let vacant = Vacant { value: Occupancy::UNKNOWN, fill };
            let mapped: Cow<'a, Grid<Occupancy>> =
                source.onto(lattice, footprint, &mapping, vacant, progress)?;
            Ok(ReachCells::Laid(mapped))
        }
    }
}
