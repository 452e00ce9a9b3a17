//! X5 run: walks on random buildings by every variant.

use std::time::Instant;

use carpin_walk::{DistanceParams, Params, align};
use ogm_core::Outcome;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::record::{CORRECTED, Walked};
use super::variants::{Variant, variants};
use crate::cases::rescue::{CASES, Case, Coverage, RescuePair};
use crate::judge::{Overlap, TransformError, WALK};
use crate::measured::{Run, RunResult};
use crate::options::Options;

/// Seeds of all variants with `quick`.
const FEW: u64 = 2;

/// Walks in every case by every variant.
pub(super) fn run(options: &Options) -> anyhow::Result<Vec<Walked>> {
    let count = options.count(10, 50);
    let of_variants = if options.quick && options.runs.is_none() { FEW } else { count };
    let seeds: Vec<u64> = (options.seed..options.seed + count).collect();
    let variants = variants();
    let mut walked: Vec<Walked> = Vec::new();
    options.watch.begin("X5 walks", (CASES.len() * seeds.len()) as u64);
    for coverage in [Coverage::Full, Coverage::Partial, Coverage::Drives] {
        let of_seeds: Vec<Vec<Walked>> = seeds
            .par_iter()
            .with_max_len(1)
            .map(|&seed| {
                let every = seed < options.seed + of_variants;
                let is_shown = |variant: &&Variant| {
                    let on_these = coverage != Coverage::Drives || variant.on_drives();
                    if every { on_these } else { is_judged(variant, coverage) }
                };
                let shown: Vec<&Variant> = variants.iter().filter(is_shown).collect();
                let walks = walks_of(&shown, coverage, seed)?;
                CASES.iter().filter(|case| case.coverage == coverage).for_each(|_| {
                    options.watch.step();
                });
                Ok(walks)
            })
            .collect::<anyhow::Result<_>>()?;
        walked.extend(of_seeds.into_iter().flatten());
    }
    options.watch.end();
    Ok(walked)
}

/// Whether the criteria look at it.
fn is_judged(variant: &Variant, coverage: Coverage) -> bool {
    coverage == Coverage::Full && variant.name == CORRECTED
}

fn walks_of(variants: &[&Variant], coverage: Coverage, seed: u64) -> anyhow::Result<Vec<Walked>> {
    if variants.is_empty() {
        return Ok(Vec::new());
    }
    let pair = RescuePair::random(coverage, seed)?;
    let mut walks = Vec::new();
    for case in CASES.iter().filter(|case| case.coverage == coverage) {
        for variant in variants {
            walks.push(walk(case, variant, &pair)?);
        }
    }
    Ok(walks)
}

fn walk(case: &Case, variant: &Variant, pair: &RescuePair) -> anyhow::Result<Walked> {
    let start = pair.start(case.start)?;
    let distance = DistanceParams { objective: variant.objective, ..DistanceParams::default() };
    let params = Params { distance, seed: pair.seed, ..Params::default() };
    let clock = Instant::now();
    let outcome = align(&pair.target, &pair.source, start, variant.rules.as_ref(), &params, &())?;
    let milliseconds = clock.elapsed().as_secs_f64() * 1e3;
    let mut at_truth = carpin_walk::MapDistance::new(&pair.target, &pair.source, &params.distance)?;
    let psi_of_truth = at_truth.psi(&pair.target_from_source)?.psi;

    let (mut success, mut below_truth, mut evaluations) = (false, false, 0);
    let result = match outcome {
        Outcome::Found(found) => {
            let pose = pair.error(&found.target_from_source)?;
            success = WALK.admits(pose, pair.target.frame().resolution());
            below_truth = found.psi < psi_of_truth;
            evaluations = found.evaluations;
            let overlap = Overlap::new(&pair.target, &pair.source, pair.target_from_source);
            let walls = overlap.errors(&found.target_from_source);
            RunResult::Transform(TransformError { pose, ..walls })
        }
        Outcome::Refused(refusal) => RunResult::Refused(refusal),
    };
    let run = Run {
        experiment: "X5",
        case: case.name.to_owned(),
        variant: variant.name.to_owned(),
        seed: pair.seed,
        result,
    };
    let (case, variant) = (case.name, variant.name);
    let shared = pair.shared()?;
    Ok(Walked { case, variant, success, below_truth, evaluations, shared, run, milliseconds })
}
