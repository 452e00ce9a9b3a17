//! X5: the Gaussian random walk of Carpin and Birk, corrected and as printed.

use std::time::Instant;

use carpin_walk::{
    Acceptance, Annealing, DistanceParams, Drift, HillClimbing, Objective, Params, RandomWalk,
    Rules, Spread, TurnUnit, align,
};
use ogm_core::Outcome;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::evaluation::Overlap;
use super::random_walk_cases::{CASES, Case, Coverage, RescuePair};
use super::record::{Run, RunResult, TransformError};
use super::{
    Args, Measured, Timing, progress, random_walk_figures, random_walk_pairs, random_walk_tables,
};
use crate::report::Section;

/// An answer is right within so many cells and degrees.
const RIGHT: [f64; 2] = [2.0, 3.0];

const ANALYSIS: &str = "\
Two robots with the paper's sensor (162°, 91 beams, 4 m, 1 % spurious readings), drifting odometry and a \
noisy compass each map a random building into 100 × 100 cells, their rows turned against each \
other by up to 15°. A walk of 200 samples starts at the true transform off by up to the stated amount, uniform \
in x, y and turn. It succeeds if it ends within 2 cells and 3° of the truth. Either both robots \
saw the whole building, or each map is cut to one side of it so that they share 60 %, or each robot \
saw what lies along its own drive.

With the whole building in both maps the picture distance is least at the truth, near enough; with a part it is \
not, and the column of runs that end below ψ(truth) shows that the walk finds what it looks for. The overlap \
objective, ours, counts only what both maps know.

Theorem 1 prints the limit 0 for the probability of being within ε of the optimum; it is 1, and \
the figure shows the share of walks that have been there after k samples.";

/// A search, its name and what it minimises.
pub(super) struct Variant {
    pub(super) name: &'static str,
    pub(super) rules: Box<dyn Rules + Sync>,
    pub(super) objective: Objective,
}

impl Variant {
    /// Whether it also runs on what the robots' own drives show; the printed forms do not.
    fn on_drives(&self) -> bool {
        [CORRECTED, CORRECTED_OVERLAP].contains(&self.name)
    }
}

/// The overlap objective with its default limit.
pub(super) const OVERLAP: Objective = Objective::Overlap { min_share: 0.25 };

pub(super) const CORRECTED: &str = "corrected";
const CORRECTED_OVERLAP: &str = "corrected, overlap only";

fn variants() -> Vec<Variant> {
    let walk = RandomWalk::default();
    let picture =
        |name, rules: Box<dyn Rules + Sync>| Variant { name, rules, objective: Objective::Picture };
    vec![
        picture(CORRECTED, Box::new(walk)),
        picture(
            "acceptance as printed (pure descent)",
            Box::new(RandomWalk { acceptance: Acceptance::AsPrinted, ..walk }),
        ),
        picture(
            "gradient ascent, as printed",
            Box::new(RandomWalk { drift: Drift::AsPrinted, ..walk }),
        ),
        picture(
            "Σ always 0.1 I (Algorithm 1)",
            Box::new(RandomWalk { spread: Spread::AsPrinted, ..walk }),
        ),
        picture("turns in radians", Box::new(RandomWalk { turn_unit: TurnUnit::Radians, ..walk })),
        picture("μ = 0", Box::new(RandomWalk { drift: Drift::None, ..walk })),
        picture(
            "μ from the last 5 steps",
            Box::new(RandomWalk { drift: Drift::History(5), ..walk }),
        ),
        picture("hill climbing", Box::<HillClimbing>::default()),
        picture("simulated annealing", Box::<Annealing>::default()),
        Variant { name: CORRECTED_OVERLAP, rules: Box::new(walk), objective: OVERLAP },
    ]
}

/// One walk.
#[derive(Debug, Clone)]
pub(super) struct Walked {
    pub(super) case: &'static str,
    pub(super) variant: &'static str,
    pub(super) success: bool,
    /// Whether it ended where the maps look more alike than at the truth.
    pub(super) below_truth: bool,
    pub(super) evaluations: usize,
    /// Share of the known cells that both maps know.
    pub(super) shared: f64,
    run: Run,
    milliseconds: f64,
}

/// Walks in every case by every variant, then on real pairs where there are any.
pub(super) fn run(args: &Args) -> anyhow::Result<Measured> {
    let seeds = match (args.runs, args.quick) {
        (Some(runs), _) => runs.into(),
        (None, true) => 2,
        (None, false) => 50,
    };
    let seeds: Vec<u64> = (args.seed..args.seed + seeds).collect();
    let variants = variants();
    let mut walked: Vec<Walked> = Vec::new();
    let bar = progress("X5 walks", (CASES.len() * seeds.len()) as u64);
    for coverage in [Coverage::Full, Coverage::Partial, Coverage::Drives] {
        let of_seeds: Vec<Vec<Walked>> = seeds
            .par_iter()
            .with_max_len(1)
            .map(|&seed| {
                let pair = RescuePair::random(coverage, seed)?;
                let mut walks = Vec::new();
                for case in CASES.iter().filter(|case| case.coverage == coverage) {
                    let shown = variants
                        .iter()
                        .filter(|variant| coverage != Coverage::Drives || variant.on_drives());
                    for variant in shown {
                        walks.push(walk(case, variant, &pair)?);
                    }
                    bar.inc(1);
                }
                Ok(walks)
            })
            .collect::<anyhow::Result<_>>()?;
        walked.extend(of_seeds.into_iter().flatten());
    }
    bar.finish_and_clear();

    let mut tables = random_walk_tables::draw(&variants, &walked);
    let mut figures = random_walk_figures::draw(args)?;
    let mut runs: Vec<Run> = walked.iter().map(|walk| walk.run.clone()).collect();
    if let Some(folder) = &args.pairs {
        let real = random_walk_pairs::run(args, folder)?;
        tables.push(real.table);
        figures.extend(real.figures);
        runs.extend(real.runs);
    }
    let timings = walked.iter().map(|walk| Timing {
        experiment: "X5",
        step: walk.variant,
        seed: walk.run.seed,
        milliseconds: walk.milliseconds,
    });
    Ok(Measured {
        timings: timings.collect(),
        sections: vec![Section {
            id: "X5".to_owned(),
            title: "Stochastic map merging (Carpin and Birk)".to_owned(),
            analysis: ANALYSIS.to_owned(),
            tables,
            figures,
            criteria: if args.quick { Vec::new() } else { random_walk_tables::criteria(&walked) },
        }],
        runs,
    })
}

fn walk(case: &Case, variant: &Variant, pair: &RescuePair) -> anyhow::Result<Walked> {
    let start = pair.start(case.start)?;
    let distance = DistanceParams { objective: variant.objective, ..DistanceParams::default() };
    let params = Params { distance, seed: pair.seed, ..Params::default() };
    let clock = Instant::now();
    let outcome = align(&pair.target, &pair.source, start, variant.rules.as_ref(), &params)?;
    let milliseconds = clock.elapsed().as_secs_f64() * 1e3;
    let mut at_truth = carpin_walk::MapDistance::new(&pair.target, &pair.source, &params.distance)?;
    let psi_of_truth = at_truth.psi(&pair.target_from_source)?.psi;

    let (mut success, mut below_truth, mut evaluations) = (false, false, 0);
    let result = match outcome {
        Outcome::Found(found) => {
            let [cells, degrees] = pair.error(&found.target_from_source)?;
            success = cells <= RIGHT[0] && degrees <= RIGHT[1];
            below_truth = found.psi < psi_of_truth;
            evaluations = found.evaluations;
            let overlap = Overlap::new(&pair.target, &pair.source, pair.target_from_source);
            RunResult::Transform(TransformError {
                translation_m: cells * pair.target.frame().resolution(),
                rotation: degrees.to_radians(),
                ..overlap.errors(&found.target_from_source)
            })
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
