//! X6c run: the whole search from scratch, on random plans and on real pairs.

use std::path::Path;
use std::time::Instant;

use ogm_core::{OccupancyGrid, Se2};
use ogm_merge::align_by_radon;
use ogm_sim::{FloorPlan, PairParams, simulate_pair};
use radon_merge::RadonParams;
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::record::Searched;
use crate::cases::map_pair::{MapPair, read_pairs};
use crate::judge::{HALF_A_DOOR, Overlap, Tolerance, TransformError};
use crate::measured::RunResult;
use crate::options::Options;

/// Random plans, few and all.
const PLANS: [u64; 2] = [6, 20];

/// The search on random plans.
pub(super) fn plans(options: &Options) -> anyhow::Result<Vec<Searched>> {
    let plans = PLANS[usize::from(!options.quick)];
    options.watch.begin("X6c plans", plans);
    let searched = (0..plans).into_par_iter().map(|index| {
        let searched = search_plan(options.seed + index);
        options.watch.step();
        searched
    });
    let searched = searched.collect();
    options.watch.end();
    searched
}

/// The search on every pair below `folder`.
pub(super) fn pairs(options: &Options, folder: &Path) -> anyhow::Result<Vec<Searched>> {
    let pairs = read_pairs(folder)?;
    options.watch.begin("pairs, by segments", pairs.len() as u64);
    let searched = pairs.par_iter().map(|pair| {
        let searched = search_pair(pair);
        options.watch.step();
        searched
    });
    let searched = searched.collect();
    options.watch.end();
    searched
}

fn search_plan(seed: u64) -> anyhow::Result<Searched> {
    let world = PairParams { seed, ..PairParams::sa() };
    let pair = simulate_pair(&FloorPlan::random(seed)?, &world)?;
    let (target, source) = (&pair.target.map, &pair.source.map);
    let overlap = Overlap::new(target, source, pair.target_from_source);
    let errors = |target_from_source: &Se2| overlap.errors(target_from_source);
    let name = format!("plan {seed}, overlap {:.0} %", 100.0 * pair.overlap()?);
    search(name, target, source, Some((&errors, HALF_A_DOOR)))
}

fn search_pair(pair: &MapPair) -> anyhow::Result<Searched> {
    let Some(truth) = &pair.truth else {
        return search(pair.name.clone(), &pair.target, &pair.source, None);
    };
    let overlap = Overlap::new(&pair.target, &pair.source, truth.target_from_source);
    let errors = |target_from_source: &Se2| truth.errors(&overlap, target_from_source);
    let judged: Judged<'_> = (&errors, truth.tolerance);
    search(pair.name.clone(), &pair.target, &pair.source, Some(judged))
}

/// How far a transform is off, and within what it is right.
type Judged<'a> = (&'a dyn Fn(&Se2) -> TransformError, Tolerance);

fn search(
    name: String,
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    judged: Option<Judged<'_>>,
) -> anyhow::Result<Searched> {
    let start = Instant::now();
    let found = align_by_radon(target, source, &RadonParams::default(), &())?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    let result = RunResult::of(&found.outcome, judged.map(|(errors, _)| errors));
    let cell = target.frame().resolution();
    let is_right = |error: &TransformError| {
        judged.is_some_and(|(_, tolerance)| tolerance.admits(error.pose, cell))
    };
    let right = judged.and_then(|(errors, _)| {
        let candidates = &found.candidates;
        candidates.iter().position(|one| is_right(&errors(&one.target_from_source())))
    });
    let is_right = matches!(&result, RunResult::Transform(error) if is_right(error));
    Ok(Searched { name, found, milliseconds, result, right, is_right })
}
