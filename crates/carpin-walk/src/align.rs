//! The front door: walks over the transforms between two maps.

use ogm_core::{OccupancyGrid, Outcome, Progress, Refusal, Se2, Steps};

use crate::walk::{Budget, Walk, walk};
use crate::{Around, End, MapDistance, Params, Rules, Sample, SearchBox, WalkError};

/// Where a source map lies in a target map, and how the search got there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Alignment {
    /// Maps source points into the target map: where ψ was least.
    pub target_from_source: Se2,
    /// ψ there, cells.
    pub psi: f64,
    /// ψ at the start, cells.
    pub start_psi: f64,
    /// How often the winning walk evaluated ψ.
    pub evaluations: usize,
    /// Why it ended.
    pub end: End,
    /// Every sample of it, in order.
    pub trace: Vec<Sample>,
    /// The transform of each of those samples.
    pub trace_target_from_source: Vec<Se2>,
    /// Least ψ of each walk; their spread says how far to trust one.
    pub walks: Vec<f64>,
}

/// Moves `source` onto `target` by a random walk from `start_target_from_source` that looks for the
/// least picture distance (Carpin and Birk, *Stochastic map merging in rescue environments*).
///
/// `rules` is the paper's [`RandomWalk`](crate::RandomWalk) or another search in its place. Of
/// several walks the best counts, the first of equals. Equal input gives equal bits on any number
/// of threads. A small ψ is no proof of a match: maps that overlap in part can look more alike
/// elsewhere, see [`Objective`](crate::Objective).
///
/// Refuses with [`Refusal::TooLittleStructure`] if the maps have neither obstacles nor free cells
/// in common, so that no transform is better than another, and with [`Refusal::NothingCompared`] if no
/// walk came by a place where they can be compared.
///
/// # Errors
/// Maps of different resolution, a start that is not finite or outside the search box, a
/// parameter outside its range, or [`WalkError::Cancelled`].
pub fn align<R: Rules + Sync + ?Sized>(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    start_target_from_source: Se2,
    rules: &R,
    params: &Params,
    progress: &dyn Progress,
) -> Result<Outcome<Alignment>, WalkError> {
    let outcome = search(target, source, start_target_from_source, rules, params, progress)?;
    progress.report(1.0);
    Ok(outcome)
}

fn search<R: Rules + Sync + ?Sized>(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    start_target_from_source: Se2,
    rules: &R,
    params: &Params,
    progress: &dyn Progress,
) -> Result<Outcome<Alignment>, WalkError> {
    params.check()?;
    progress.go_on(0.0)?;
    let mut distance = MapDistance::new(target, source, &params.distance)?;
    let start = start_target_from_source;
    start.check_finite()?;
    let place = distance.placement(&start);
    let [width, height] = distance.mean_size();
    let space = SearchBox {
        centre: match params.around {
            Around::Target => [0.0; 3],
            Around::Start => place,
        },
        reach: [params.reach * width, params.reach * height, params.turn.to_degrees()],
    };
    let place = space.check_start(place)?;
    let [in_target, in_source] = distance.class_counts();
    if (0..in_target.len()).all(|class| in_target[class].min(in_source[class]) == 0) {
        let have = in_target[0].min(in_source[0]);
        return Ok(Outcome::Refused(Refusal::TooLittleStructure { have, need: 1 }));
    }

    let samples = Steps::new(progress, params.walks.saturating_mul(params.samples));
    let one = |stream| {
        let mut distance = distance.clone();
        let budget = Budget { samples: params.samples, seed: params.seed, stream };
        walk(|at| distance.psi_at(at).psi, place, &space, rules, &budget, &samples)
    };
    let walks = each_stream(params.walks as u64, one)?;
    let bests: Vec<f64> = walks.iter().map(|walk| walk.best_psi).collect();
    let winner = walks.into_iter().reduce(
        |best, walk| {
            if walk.best_psi < best.best_psi { walk } else { best }
        },
    );
    let Some(winner) = winner else {
        return Ok(Outcome::Refused(Refusal::NothingCompared));
    };
    let there = distance.psi_at(&winner.best);
    if there.common_classes == 0 || !there.psi.is_finite() {
        return Ok(Outcome::Refused(Refusal::NothingCompared));
    }
    // The start stays the start, to the bit.
    let at_start = winner.best == place;
    let target_from_source =
        if at_start { start } else { distance.target_from_source(&winner.best) };
    Ok(Outcome::Found(Alignment {
        target_from_source,
        psi: winner.best_psi,
        start_psi: winner.start_psi,
        evaluations: winner.evaluations,
        end: winner.end,
        trace_target_from_source: winner
            .trace
            .iter()
            .map(|sample| distance.target_from_source(&sample.at))
            .collect(),
        trace: winner.trace,
        walks: bests,
    }))
}

/// One walk a stream, in their order.
#[cfg(feature = "rayon")]
fn each_stream(
    count: u64,
    walk: impl Fn(u64) -> Result<Walk, WalkError> + Sync,
) -> Result<Vec<Walk>, WalkError> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    (0..count).into_par_iter().map(&walk).collect()
}

/// One walk a stream, in their order.
#[cfg(not(feature = "rayon"))]
fn each_stream(
    count: u64,
    walk: impl Fn(u64) -> Result<Walk, WalkError> + Sync,
) -> Result<Vec<Walk>, WalkError> {
    (0..count).map(walk).collect()
}
