//! X4 run: every variant on its share of the worlds.

use std::time::Instant;

use grid_match::{MatchParams, match_maps};
use ogm_core::Se2;
use ogm_merge::{RobotMap, align_by_tags};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::readers::{self, Believed};
use super::record::{MATCH, NEGATIVES, REGIMES, case_name, case_without_tags};
use super::variants::{METHODS, ON_ALL_WORLDS, VARIANTS};
use crate::cases::worlds::{Building, World};
use crate::judge::{Overlap, TransformError};
use crate::measured::{Run, RunResult, Timing};
use crate::options::Options;

/// Worlds in memory at once; the robots of neighbours are also set against each other.
const TOGETHER: usize = 10;

/// Worlds of plan A, shown apart.
const PLAN_A_WORLDS: u64 = 10;

/// What the worlds gave.
pub(super) struct Everything {
    pub(super) runs: Vec<Run>,
    pub(super) timings: Vec<Timing>,
    pub(super) believed: Vec<Believed>,
}

/// Runs every variant on its share of the worlds.
pub(super) fn run(options: &Options) -> anyhow::Result<Everything> {
    let worlds = options.count(12, 200);
    let of_variants = options.runs.map_or(if options.quick { 3 } else { 50 }, |runs| runs.min(50));
    let of_plan_a = PLAN_A_WORLDS.min(options.count(3, 200));
    options.watch.begin("X4 worlds", worlds + of_plan_a);
    let run_worlds = |building, count: u64, of_variants: u64| {
        let mut measured = Vec::new();
        let seeds: Vec<u64> = (0..count).map(|index| options.seed + index).collect();
        for seeds in seeds.chunks(TOGETHER) {
            let worlds = seeds.par_iter().map(|&seed| World::simulate(building, seed));
            let worlds = worlds.collect::<anyhow::Result<Vec<World>>>()?;
            let runs = worlds.par_iter().enumerate().map(|(index, world)| {
                let all_variants = world.seed - options.seed < of_variants;
                let mut measured = run_world(building, world, all_variants)?;
                let next = &worlds[(index + 1) % worlds.len()];
                if next.seed != world.seed && matches!(building, Building::Random) {
                    measured.0.extend(run_strangers(world, next)?);
                }
                let (by_readers, believed) = match building {
                    Building::Random => readers::run(world)?,
                    Building::PlanA => Default::default(),
                };
                measured.0.extend(by_readers);
                options.watch.step();
                Ok((measured.0, measured.1, believed))
            });
            measured.extend(runs.collect::<anyhow::Result<Vec<_>>>()?);
        }
        anyhow::Ok(measured)
    };
    let random = run_worlds(Building::Random, worlds, of_variants.into())?;
    let plan_a = run_worlds(Building::PlanA, of_plan_a, of_plan_a)?;
    options.watch.end();
    let mut all = Everything { runs: Vec::new(), timings: Vec::new(), believed: Vec::new() };
    for (runs, timings, believed) in random.into_iter().chain(plan_a) {
        all.runs.extend(runs);
        all.timings.extend(timings);
        all.believed.extend(believed);
    }
    Ok(all)
}

/// Every method on the target of one world and the source of another.
fn run_strangers(world: &World, other: &World) -> anyhow::Result<Vec<Run>> {
    let target = RobotMap { map: &world.pair.target.map, tags: &world.target_tags };
    let source = RobotMap { map: &other.pair.source.map, tags: &other.source_tags };
    let mut runs = Vec::new();
    for variant in &VARIANTS[..METHODS] {
        let params = (variant.params)(world);
        let report = align_by_tags(variant.method, &target, &source, &params, &())?;
        runs.push(Run {
            experiment: "X4",
            case: NEGATIVES.to_owned(),
            variant: variant.name.to_owned(),
            seed: world.seed,
            result: RunResult::of(&report.outcome, None::<fn(&Se2) -> TransformError>),
        });
    }
    Ok(runs)
}

fn run_world(
    building: Building,
    world: &World,
    all_variants: bool,
) -> anyhow::Result<(Vec<Run>, Vec<Timing>)> {
    let seed = world.seed;
    let overlap =
        Overlap::new(&world.pair.target.map, &world.pair.source.map, world.target_from_source());
    let errors = Some(|target_from_source: &Se2| overlap.errors(target_from_source));
    let variants = if all_variants { &VARIANTS[..] } else { &VARIANTS[..ON_ALL_WORLDS] };
    let (mut runs, mut timings) = (Vec::new(), Vec::new());
    for sigma_px in REGIMES {
        let [target_tags, source_tags] = world.displaced_tags(sigma_px);
        let target = RobotMap { map: &world.pair.target.map, tags: &target_tags };
        let source = RobotMap { map: &world.pair.source.map, tags: &source_tags };
        for variant in variants {
            let params = (variant.params)(world);
            let start = Instant::now();
            let report = align_by_tags(variant.method, &target, &source, &params, &())?;
            let milliseconds = start.elapsed().as_secs_f64() * 1e3;
            let result = RunResult::of(&report.outcome, errors);
            runs.push(Run {
                experiment: "X4",
                case: case_name(building, sigma_px),
                variant: variant.name.to_owned(),
                seed,
                result,
            });
            timings.push(Timing { experiment: "X4", step: variant.name, seed, milliseconds });
        }
    }
    let start = Instant::now();
    let (target, source) = (&world.pair.target.map, &world.pair.source.map);
    let report = match_maps(target, source, &MatchParams::default(), &())?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    runs.push(Run {
        experiment: "X4",
        case: case_without_tags(building),
        variant: MATCH.to_owned(),
        seed,
        result: RunResult::of(&report.outcome, errors),
    });
    timings.push(Timing { experiment: "X4", step: MATCH, seed, milliseconds });
    Ok((runs, timings))
}
