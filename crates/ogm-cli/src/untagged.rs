//! The papers' methods that need no tags.

use carpin_walk::{Around, DistanceParams, Objective, Params};
use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Refusal, Se2};
use ogm_merge::{CarpinParams, align_by_radon, align_carpin};
use radon_merge::{Candidate, RadonParams};

use crate::args::SearchArgs;
use crate::found::Found;
use crate::pose::Sigma;

/// Cells of the first walk, metres: a walk reaches some 15 cells, so on large ones it reaches far.
const COARSE_M: f64 = 0.2;

/// Standard deviations to which a prior is believed.
const SIGMAS: f64 = 3.0;

/// By a random walk, which always ends somewhere: refused unless the maps make that likelier right
/// than wrong.
///
/// Walks on large cells first and from where that ends on the maps' own.
pub(crate) fn by_walk(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    args: &SearchArgs,
) -> anyhow::Result<Found> {
    const METHOD: &str = "carpin";
    let maps = [target, source];
    let prior = args.prior.map(Se2::from);
    let mut target_from_source = prior.unwrap_or_else(|| middle_on_middle(target, source));
    for params in walks(maps, args) {
        match align_carpin(target, source, target_from_source, &params)?.outcome {
            Outcome::Found(found) => target_from_source = found.target_from_source,
            Outcome::Refused(refusal) => {
                return Found::scored(METHOD, Outcome::Refused(refusal), None, maps);
            }
        }
    }
    let outcome = Outcome::Found(target_from_source);
    let mut found = Found::scored(METHOD, outcome, Some(target_from_source), maps)?;
    let log_odds = found.hypotheses.first().map_or(f64::NEG_INFINITY, |best| best.score);
    if log_odds <= 0.0 {
        let probability = 1.0 / (1.0 + (-log_odds).exp());
        found.outcome = Outcome::Refused(Refusal::Unlikely { probability, need: 0.5 });
    }
    Ok(found)
}

/// Four walks on large cells within what a prior allows, then one to settle on the maps' own.
///
/// Only what both maps know is compared: the paper's own measure draws maps together that overlap
/// in part.
fn walks(maps: [&OccupancyGrid; 2], args: &SearchArgs) -> [CarpinParams; 2] {
    let distance = DistanceParams {
        objective: Objective::Overlap { min_share: 0.25 },
        thresholds: ClassThresholds::default(),
        ..DistanceParams::default()
    };
    let around = Around::Start;
    let free = Params { distance, seed: args.seed, around, walks: 4, ..Params::default() };
    let coarse = match args.prior_sigma {
        Some(Sigma { metres, degrees }) => {
            within(free, SIGMAS * metres, SIGMAS * degrees.to_radians(), maps)
        }
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

/// By wall segments that look alike, tuned and verified.
pub(crate) fn by_segments(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    args: &SearchArgs,
) -> anyhow::Result<Found> {
    let params = RadonParams { seed: args.seed, ..RadonParams::default() };
    let found = align_by_radon(target, source, &params)?;
    let verified = found.candidates.iter().find(|candidate| candidate.verified);
    let best = match &found.outcome {
        Outcome::Found(target_from_source) => Some(*target_from_source),
        Outcome::Refused(_) => {
            verified.or(found.candidates.first()).map(Candidate::target_from_source)
        }
    };
    Found::scored("radon", found.outcome, best, [target, source])
}
