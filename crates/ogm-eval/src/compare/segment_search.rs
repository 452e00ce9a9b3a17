//! X6c: the whole search from scratch, on random plans and on real pairs.

use std::path::Path;
use std::time::Instant;

use ogm_core::{OccupancyGrid, Outcome, Se2};
use ogm_merge::align_by_radon;
use ogm_sim::{FloorPlan, PairParams, simulate_pair};
use radon_merge::{RadonMatch, RadonParams};
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::evaluation::Overlap;
use super::record::{Run, RunResult, TransformError, pose_error};
use super::segment_merge::outcome_text;
use super::{Args, Measured, Timing, progress};
use crate::map_pair::{MapPair, read_pairs};
use crate::report::{Criterion, Section, Table};
use crate::stats::wilson_ci95;

/// Random plans without `--quick`.
const PLANS: u64 = 20;

/// Within this an answer is right, metres and radians; half the width of a door.
const RIGHT_M: f64 = 0.25;
const RIGHT_RAD: f64 = 0.0175;

const ANALYSIS: &str = "\
Two robots with the paper's lidar in a random office floor each, maps in frames of random heading, \
nothing given. Segments that look alike propose poses; each is judged by how walls meet; the best \
sixteen are tuned and verified. The hypothesis that is listed is the first at the pose in the \
order in which they were made. An answer is right within 0.25 m and 1°.";

const PAIRS_ANALYSIS: &str = "\
Real maps, no tags. Two maps are merged only where nine in ten walls meet within a cell, so maps \
that drift has bent are refused. Right in candidates says whether the true pose is among those \
that were tuned.";

struct Case {
    name: String,
    found: RadonMatch,
    milliseconds: f64,
    /// Of the answer or, where there is none, of nothing.
    result: RunResult,
    /// Which candidate is right, the first.
    right: Option<usize>,
    /// Metres and radians within which an answer is right.
    tolerance: Option<(f64, f64)>,
}

impl Case {
    fn is_right(&self) -> bool {
        matches!((&self.result, self.tolerance), (RunResult::Transform(e), Some(within))
            if e.translation_m < within.0 && e.rotation < within.1)
    }

    fn is_wrong(&self) -> bool {
        !self.is_right() && self.found.accepted.is_some()
    }
}

pub(super) fn run(args: &Args) -> anyhow::Result<Measured> {
    let plans = if args.quick { 3 } else { PLANS };
    let bar = progress("X6c plans", plans);
    let cases: Vec<Case> = (0..plans)
        .into_par_iter()
        .map(|index| {
            let case = search_plan(args.seed + index);
            bar.inc(1);
            case
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();

    let right = cases.iter().filter(|case| case.is_right()).count();
    let wrong = cases.iter().filter(|case| case.is_wrong()).count();
    let share = right as f64 / cases.len() as f64;
    let criteria = vec![
        Criterion {
            id: "X6c success".to_owned(),
            statement: format!("right on {right} of {}, at least 60 %", cases.len()),
            paper: Some("works on 3 maps".to_owned()),
            ours: share,
            interval: Some(wilson_ci95(right, cases.len())),
            pass: share >= 0.6,
        },
        no_wrong("X6c wrong", wrong),
    ];
    let section = Section {
        id: "X6c".to_owned(),
        title: "The search from scratch".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![table(&cases)],
        figures: Vec::new(),
        criteria,
    };
    Ok(measured("X6c", section, cases, args.seed))
}

/// The search on every pair below `folder`.
pub(super) fn run_pairs(args: &Args, folder: &Path) -> anyhow::Result<Measured> {
    let pairs = read_pairs(folder)?;
    let bar = progress("pairs, by segments", pairs.len() as u64);
    let cases: Vec<Case> = pairs
        .par_iter()
        .map(|pair| {
            let case = search_pair(pair);
            bar.inc(1);
            case
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();
    let wrong = cases.iter().filter(|case| case.is_wrong()).count();
    let section = Section {
        id: "X6 pairs".to_owned(),
        title: "Real pairs by wall segments".to_owned(),
        analysis: PAIRS_ANALYSIS.to_owned(),
        tables: vec![table(&cases)],
        figures: Vec::new(),
        criteria: vec![no_wrong("X6 pairs wrong", wrong)],
    };
    Ok(measured("X6 pairs", section, cases, args.seed))
}

fn no_wrong(id: &str, wrong: usize) -> Criterion {
    Criterion {
        id: id.to_owned(),
        statement: "no wrong pose is verified".to_owned(),
        paper: None,
        ours: wrong as f64,
        interval: None,
        pass: wrong == 0,
    }
}

fn search_plan(seed: u64) -> anyhow::Result<Case> {
    let world = PairParams { seed, ..PairParams::sa() };
    let pair = simulate_pair(&FloorPlan::random(seed)?, &world)?;
    let (target, source) = (&pair.target.map, &pair.source.map);
    let overlap = Overlap::new(target, source, pair.target_from_source);
    let errors = |target_from_source: &Se2| overlap.errors(target_from_source);
    let name = format!("plan {seed}, overlap {:.0} %", 100.0 * pair.overlap()?);
    search(name, target, source, Some((&errors, (RIGHT_M, RIGHT_RAD))))
}

fn search_pair(pair: &MapPair) -> anyhow::Result<Case> {
    let Some(truth) = &pair.truth else {
        return search(pair.name.clone(), &pair.target, &pair.source, None);
    };
    let overlap = Overlap::new(&pair.target, &pair.source, truth.target_from_source);
    let centroid = pair.source_centroid();
    let errors = |target_from_source: &Se2| {
        let (translation_m, rotation) =
            pose_error(target_from_source, &truth.target_from_source, centroid);
        TransformError { translation_m, rotation, ..overlap.errors(target_from_source) }
    };
    let within = (truth.tolerance_m, truth.tolerance);
    search(pair.name.clone(), &pair.target, &pair.source, Some((&errors, within)))
}

/// How far a transform is off, and within which distance and angle it is right.
type Truth<'a> = (&'a dyn Fn(&Se2) -> TransformError, (f64, f64));

fn search(
    name: String,
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    truth: Option<Truth<'_>>,
) -> anyhow::Result<Case> {
    #[expect(clippy::disallowed_methods, reason = "an experiment times what it runs")]
    let start = Instant::now();
    let found = align_by_radon(target, source, &RadonParams::default())?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    let result = match (&found.outcome, truth) {
        (Outcome::Refused(refusal), _) => RunResult::Refused(refusal.clone()),
        (Outcome::Found(target_from_source), Some((errors, _))) => {
            RunResult::Transform(errors(target_from_source))
        }
        (Outcome::Found(_), None) => RunResult::FalseMerge,
    };
    let right = truth.and_then(|(errors, within)| {
        found.candidates.iter().position(|candidate| {
            let error = errors(&candidate.target_from_source());
            error.translation_m < within.0 && error.rotation < within.1
        })
    });
    Ok(Case { name, found, milliseconds, result, right, tolerance: truth.map(|t| t.1) })
}

fn table(cases: &[Case]) -> Table {
    let rows = cases.iter().map(|case| {
        let dash = || "–".to_owned();
        let candidate = case.right.and_then(|right| case.found.candidates.get(right));
        let error = match &case.result {
            RunResult::Transform(e) => {
                format!("{:.3} m, {:.2}°", e.translation_m, e.rotation.to_degrees())
            }
            _ => dash(),
        };
        vec![
            case.name.clone(),
            case.found.compared.to_string(),
            case.found.hypotheses.to_string(),
            candidate.map_or_else(dash, |one| (one.hypothesis.order + 1).to_string()),
            case.right.map_or_else(dash, |right| (right + 1).to_string()),
            error,
            if case.is_wrong() { "WRONG".to_owned() } else { outcome_text(&case.found.outcome) },
        ]
    });
    Table {
        caption: "Hypotheses made, the first right one, its rank among the tuned, and the answer."
            .to_owned(),
        header: [
            "maps",
            "segment pairs",
            "hypotheses",
            "first right",
            "right in candidates",
            "error",
            "answer",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.collect(),
    }
}

fn measured(id: &'static str, section: Section, cases: Vec<Case>, seed: u64) -> Measured {
    let timings = cases.iter().map(|case| Timing {
        experiment: id,
        step: "find_transform",
        seed,
        milliseconds: case.milliseconds,
    });
    let timings = timings.collect();
    let runs = cases.into_iter().map(|case| Run {
        experiment: id,
        case: case.name,
        variant: "radon".to_owned(),
        seed,
        result: case.result,
    });
    Measured { sections: vec![section], runs: runs.collect(), timings }
}
