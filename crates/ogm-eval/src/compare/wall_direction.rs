//! X3: the direction of a building over many extractions, beside the paper's section 5.1.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::time::Instant;

use ogm_core::{OccupancyGrid, Outcome, wrap_period};
use ogm_sim::{FloorPlan, PairParams, survey};
use ogm_vector::{OgmVector, Weights, ogm_vector};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::record::{Run, RunResult};
use super::{Args, Measured, Timing, direction_figures, format, progress};
use crate::report::{Criterion, Section, Table};
use crate::stats::{Summary, student_half_width};

/// The paper's standard deviation, degrees.
const PAPER_SD: f64 = 0.5598;

const TURNED: &str = "turned by ";

/// Map headings of X3d, degrees: the axis-aligned wall directions turn by this.
fn headings() -> impl Iterator<Item = f64> {
    std::iter::once(45.0).chain((1..20).map(|i| f64::from(i) * 18.5))
}

const ANALYSIS: &str = "\
One map of plan A (14 × 12 m, 700 × 600 px of 0.02 m) made along both robots' paths, extracted \
once for each seed. The paper's −45° is what an axis-aligned map reads: its vector is the bisector \
of two perpendicular walls. Walls fix a direction only modulo 90°, so errors are wrapped to ±45°.

X3a uses the values of the paper, the bisector, and the weights as printed; X3b the same lines with \
weights that prefer reliable walls; X3c the defaults. X3d turns the map by 45° and by 19 other \
angles. The paper's own mean is 2.8 standard errors from −45°; the 95 % interval of its σ over 1000 \
runs is 0.536 to 0.585.";

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

/// Extracts the direction of plan A's map for many seeds and headings.
pub(super) fn run(args: &Args) -> anyhow::Result<Measured> {
    let plan = FloorPlan::plan_a();
    let robots = PairParams { seed: args.seed, ..PairParams::default() };
    let map = survey(&plan, 0.0, &robots)?.map;
    let mut measured = Measured::default();

    let bar = progress("X3 extractions", 3 * args.extractions() + 20);
    for form in &forms() {
        let results = extract_many(form, &map, 0.0, args.seed, args.extractions(), || bar.inc(1))?;
        measured.runs.extend(results.iter().map(|r| r.run(form.id, "axis-aligned", form.name)));
        measured.timings.extend(results.iter().map(|r| r.timing(form.id)));
    }
    let per_heading = args.extractions().div_ceil(20);
    let default = &forms()[2];
    for heading in headings() {
        let turned = survey(&plan, heading.to_radians(), &robots)?.map;
        let results =
            extract_many(default, &turned, heading.to_radians(), args.seed, per_heading, || {})?;
        let case = heading_case(heading);
        measured.runs.extend(results.iter().map(|r| r.run("X3d", &case, default.name)));
        bar.inc(1);
    }
    bar.finish_and_clear();

    measured.sections.push(Section {
        id: "X3".to_owned(),
        title: "The direction of a building (section 5.1)".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![directions(args, &measured.runs), times(&measured.timings)],
        figures: direction_figures::draw(&map, &measured, args.seed)?,
        criteria: if args.quick { Vec::new() } else { criteria(&measured.runs) },
    });
    Ok(measured)
}

fn heading_case(heading: f64) -> String {
    format!("{TURNED}{heading}°")
}

/// The heading of a run of X3d, degrees.
pub(super) fn heading_of(run: &Run) -> Option<f64> {
    run.case.strip_prefix(TURNED)?.strip_suffix('°')?.parse().ok()
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

pub(super) fn errors_deg(runs: &[Run], experiment: &str) -> Vec<f64> {
    let chosen = runs.iter().filter(|run| run.experiment == experiment);
    chosen
        .filter_map(|run| match run.result {
            RunResult::Direction(error) => Some(error.to_degrees()),
            _ => None,
        })
        .collect()
}

fn directions(args: &Args, runs: &[Run]) -> Table {
    let rows = [
        ("X3a", "paper's values, printed weights", "−45.0497 ± 0.5598"),
        ("X3b", "paper's values, corrected weights", "–"),
        ("X3c", "default: least-squares directions, four-fold mean", "–"),
        ("X3d", "default, map turned by 45° and 19 other angles", "–"),
    ]
    .map(|(id, what, paper)| {
        let errors = errors_deg(runs, id);
        let refused = runs.iter().filter(|run| run.experiment == id).count() - errors.len();
        let first = &errors[..errors.len().min(5)];
        let five = Summary::of(first).zip(student_half_width(first));
        let mut row = vec![id.to_owned(), what.to_owned(), paper.to_owned()];
        row.push(five.map_or("–".to_owned(), |(s, half)| {
            format!("{:.4} ± {:.4} (mean ± {half:.4})", s.mean - 45.0, s.sd)
        }));
        match Summary::of(&errors) {
            Some(s) => row.extend([
                format!("{:.4} ± {:.4}", s.mean - 45.0, s.sd),
                format!("{:+.4} [{:+.4}, {:+.4}]", s.mean, s.ci95.0, s.ci95.1),
                format::degrees(s.max.abs().max(s.min.abs())),
                s.n.to_string(),
            ]),
            None => row.extend(["–", "–", "–", "0"].map(str::to_owned)),
        }
        row.push(refused.to_string());
        row
    });
    Table {
        caption: format!(
            "Angle of the OGM vector less the map's heading, mean ± standard deviation, degrees; \
             with Student's t half-width of the mean for five; deviation \
             of the mean from the truth with its bootstrap 95 % interval. Seeds from {}.",
            args.seed
        ),
        header: [
            "",
            "form",
            "paper, 1000 runs",
            "ours, 5 runs",
            "ours, all runs",
            "mean − truth",
            "largest error",
            "runs",
            "refused",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.to_vec(),
    }
}

fn times(timings: &[Timing]) -> Table {
    let rows = ["X3a", "X3b", "X3c"].map(|id| {
        let values: Vec<f64> =
            timings.iter().filter(|t| t.experiment == id).map(|t| t.milliseconds).collect();
        let paper = if id == "X3a" { "938.67 ± 154.05" } else { "–" };
        let ours = Summary::of(&values)
            .map_or("–".to_owned(), |s| format!("{:.2} ± {:.2}", s.mean, s.sd));
        vec![id.to_owned(), paper.to_owned(), ours]
    });
    Table {
        caption: "Time from the map to its vector, ms; the paper's on a 2.8 GHz i7, as context."
            .to_owned(),
        header: ["", "paper", "ours"].map(str::to_owned).to_vec(),
        rows: rows.to_vec(),
    }
}

fn criteria(runs: &[Run]) -> Vec<Criterion> {
    let summary = |id: &str| Summary::of(&errors_deg(runs, id));
    let (mean_b, interval_b, sd_b) =
        summary("X3b").map_or((f64::NAN, None, f64::NAN), |s| (s.mean.abs(), Some(s.ci95), s.sd));
    let sd_d = summary("X3d").map_or(f64::NAN, |s| s.sd);
    let sd_c = summary("X3c").map_or(f64::NAN, |s| s.sd);
    let criterion = |id: &str, statement: &str, paper: &str, ours: f64, interval, pass| Criterion {
        id: id.to_owned(),
        statement: statement.to_owned(),
        paper: Some(paper.to_owned()),
        ours,
        interval,
        pass,
    };
    vec![
        criterion(
            "X3b: mean",
            "corrected weights: |mean − truth| ≤ 0.1°",
            "0.0497",
            mean_b,
            interval_b,
            mean_b <= 0.1,
        ),
        criterion(
            "X3b: σ",
            "corrected weights: σ ≤ 0.5598°",
            "0.5598",
            sd_b,
            None,
            sd_b <= PAPER_SD,
        ),
        criterion("X3c: σ", "default: σ ≤ 0.2°", "0.5598", sd_c, None, sd_c <= 0.2),
        criterion("X3d: σ", "default, turned maps: σ ≤ 0.2°", "0.5598", sd_d, None, sd_d <= 0.2),
    ]
}
