//! What the rows of X3 say: the error of each extraction, and the heading it was made at.

use crate::measured::{Run, RunResult};

const TURNED: &str = "turned by ";

pub(super) fn heading_case(heading: f64) -> String {
    format!("{TURNED}{heading}°")
}

/// The heading of a run of X3d, degrees.
pub(super) fn heading_of(run: &Run) -> Option<f64> {
    run.case.strip_prefix(TURNED)?.strip_suffix('°')?.parse().ok()
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

/// Extractions of a form, refused ones too.
pub(super) fn count(runs: &[Run], experiment: &str) -> usize {
    runs.iter().filter(|run| run.experiment == experiment).count()
}
