//! X3 run: the direction of plan A's map for many seeds and headings.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::time::Instant;

use ogm_core::{OccupancyGrid, Outcome, wrap_period};
use ogm_sim::{FloorPlan, PairParams, survey};
use ogm_vector::{OgmVector, Weights, ogm_vector};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::record::heading_case;
use crate::measured::{Measured, Run, RunResult, Timing};
use crate::options::Options;

/// Map headings of X3d, degrees: the axis-aligned wall directions turn by this.
fn headings() -> impl Iterator<Item = f64> {
    std::iter::once(45.0).chain((1..20).map(|i| f64::from(i) * 18.5))
}

/// A way to get a direction from a map.
struct Form {
    id: &'static str,
    name: &'static str,
    lines: line_ransac::Params,
    vector: ogm_vector::Params,
}

fn forms() -> [Form; 3] {
    [
        Form {
            id: "X3a",
            name: "paper's values, printed weights",
            lines: line_ransac::Params::paper(),
            vector: ogm_vector::Params {
                weights: Weights::AsPrinted,
                ..ogm_vector::Params::paper()
            },
        },
        Form {
            id: "X3b",
            name: "paper's values, corrected weights",
            lines: line_ransac::Params::paper(),
            vector: ogm_vector::Params::paper(),
        },
        Form {
            id: "X3c",
            name: "default",
            lines: line_ransac::Params::default(),
            vector: ogm_vector::Params::default(),
        },
    ]
}

/// Every extraction of the map, and of the map turned.
pub(super) fn run(options: &Options, map: &OccupancyGrid) -> anyhow::Result<Measured> {
    let count = extractions(options);
    let mut measured = Measured::default();
    options.watch.begin("X3 extractions", 3 * count + 20);
    let step = || options.watch.step();
    for form in &forms() {
        let results = extract_many(form, map, 0.0, options.seed, count, step)?;
        measured.runs.extend(results.iter().map(|r| r.run(form.id, "axis-aligned", form.name)));
        measured.timings.extend(results.iter().map(|r| r.timing(form.id)));
    }
    let per_heading = count.div_ceil(20);
    let default = &forms()[2];
    for heading in headings() {
        let (turned, angle) = (plan_a(options, heading)?, heading.to_radians());
        let results = extract_many(default, &turned, angle, options.seed, per_heading, || {})?;
        let case = heading_case(heading);
        measured.runs.extend(results.iter().map(|r| r.run("X3d", &case, default.name)));
        step();
    }
    options.watch.end();
    Ok(measured)
}

/// A survey of plan A in a frame turned by `heading` degrees.
pub(super) fn plan_a(options: &Options, heading: f64) -> anyhow::Result<OccupancyGrid> {
    let robots = PairParams { seed: options.seed, ..PairParams::default() };
    Ok(survey(&FloorPlan::plan_a(), heading.to_radians(), &robots)?.map)
}

/// Extractions of one map.
fn extractions(options: &Options) -> u64 {
    options.runs.map_or(if options.quick { 20 } else { 1000 }, |runs| 5 * u64::from(runs))
}

/// One extraction.
struct Extracted {
    seed: u64,
    error: Outcome<f64>,
    milliseconds: f64,
}

impl Extracted {
    fn run(&self, experiment: &'static str, case: &str, variant: &str) -> Run {
        Run {
            experiment,
            case: case.to_owned(),
            variant: variant.to_owned(),
            seed: self.seed,
            result: match &self.error {
                Outcome::Found(error) => RunResult::Direction(*error),
                Outcome::Refused(refusal) => RunResult::Refused(refusal.clone()),
            },
        }
    }

    fn timing(&self, experiment: &'static str) -> Timing {
        let (seed, milliseconds) = (self.seed, self.milliseconds);
        Timing { experiment, step: "lines and vector", seed, milliseconds }
    }
}

fn extract_many(
    form: &Form,
    map: &OccupancyGrid,
    map_heading: f64,
    first_seed: u64,
    count: u64,
    done: impl Fn() + Sync,
) -> anyhow::Result<Vec<Extracted>> {
    let results = (first_seed..first_seed + count).into_par_iter().map(|seed| {
        let start = Instant::now();
        let lines = line_ransac::Params { seed, ..form.lines.clone() };
        let vector = line_ransac::extract_segments(map, &lines)
            .into_result()
            .and_then(|extraction| ogm_vector(&extraction.segments, &form.vector).into_result());
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        done();
        // A wall along the world's x axis lies at minus the heading in the map's frame.
        let error = vector
            .map(|v: OgmVector| wrap_period(v.theta_ogm() + FRAC_PI_4 + map_heading, FRAC_PI_2));
        Extracted { seed, error: error.into(), milliseconds }
    });
    Ok(results.collect())
}
