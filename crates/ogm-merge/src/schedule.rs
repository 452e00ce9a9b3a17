//! Where a random walk starts, how far it may go, and how it comes to rest.

use carpin_walk::{Around, DistanceParams, Params};
use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Progress, Se2, Stage};

use crate::walk::{CarpinParams, CarpinReport, align_carpin};
use crate::{AlignParams, MergeError};

/// Cells of the first walk, metres: a walk reaches some 15 cells, so on large ones it reaches far.
const COARSE_M: f64 = 0.2;

/// Standard deviations to which a prior is believed.
const SIGMAS: f64 = 3.0;

/// Walks on large cells from the prior, or else from the maps' middles on each other, and from
/// where that ends on the maps' own; ends early where a walk is refused.
pub(crate) fn walk_coarse_to_fine(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    params: &AlignParams,
    progress: &dyn Progress,
) -> Result<Vec<CarpinReport>, MergeError> {
    let prior = params.prior.as_ref();
    let mut target_from_source = match prior {
        Some(prior) => prior.target_from_source,
        None => middle_on_middle(target, source),
    };
    let mut walks = Vec::new();
    for (params, part) in walk_params([target, source], params).iter().zip(0_u8..) {
        let part = Stage::new(progress, 0.5 * f64::from(part), 0.5 * f64::from(part + 1));
        let walk = align_carpin(target, source, target_from_source, params, &part)?;
        let ended = match &walk.outcome {
            Outcome::Found(found) => Some(found.target_from_source),
            Outcome::Refused(_) => None,
        };
        walks.push(walk);
        match ended {
            Some(end_target_from_source) => target_from_source = end_target_from_source,
            None => break,
        }
    }
    Ok(walks)
}

/// Four walks on large cells within what a prior allows, then one to settle on the maps' own.
fn walk_params(maps: [&OccupancyGrid; 2], params: &AlignParams) -> [CarpinParams; 2] {
    let &AlignParams { prior, seed, walk_objective: objective, .. } = params;
    let distance = DistanceParams {
        objective,
        thresholds: ClassThresholds::default(),
        ..DistanceParams::default()
    };
    let free = Params { distance, seed, around: Around::Start, walks: 4, ..Params::default() };
    let coarse = match prior {
        Some(prior) => within(free, SIGMAS * prior.sigma_m, SIGMAS * prior.sigma_rad, maps),
        None => free,
    };
    let fine = Params { walks: 1, ..within(coarse, COARSE_M, 2_f64.to_radians(), maps) };
    [(COARSE_M, coarse), (0.0, fine)].map(|(min_resolution, search)| CarpinParams {
        search,
        min_resolution,
        ..CarpinParams::default()
    })
}

/// Bounded closer to the start. The bounds of a walk are shares of the sides of the maps, so along
/// the shorter side they are closer than `reach_m`.
fn within(search: Params, reach_m: f64, turn: f64, maps: [&OccupancyGrid; 2]) -> Params {
    let mean = |cells: fn(&OccupancyGrid) -> usize| {
        maps.iter().map(|map| cells(map) as f64 * map.frame().resolution()).sum::<f64>() / 2.0
    };
    let side = mean(OccupancyGrid::width).max(mean(OccupancyGrid::height));
    Params { reach: search.reach.min(reach_m / side), turn: search.turn.min(turn), ..search }
}

/// The source's middle on the target's and rows along rows, where the paper's search is centred.
fn middle_on_middle(target: &OccupancyGrid, source: &OccupancyGrid) -> Se2 {
    let target_from_middle = from_middle(target);
    target_from_middle * from_middle(source).inverse()
}

/// The middle of a map as a frame, its x axis along the rows.
fn from_middle(map: &OccupancyGrid) -> Se2 {
    let half = Point2::new(map.width() as f64 / 2.0, map.height() as f64 / 2.0);
    let middle = map.frame().point_from_cells(half);
    Se2::new(middle.x, middle.y, map.frame().map_from_grid().theta())
}
