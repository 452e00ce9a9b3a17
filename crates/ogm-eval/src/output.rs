//! The files of a comparison: the report, every run, and the times, which are in no other file.

use std::path::Path;

use crate::measured::{Measured, Run};
use crate::report::{self, Report};

/// Writes everything into the output folder.
pub(crate) fn write(report: &Report, measured: &Measured, out: &Path) -> anyhow::Result<()> {
    report::write_all(report, out)?;
    let rows: Vec<Vec<String>> = measured.runs.iter().map(Run::cells).collect();
    report::write_file(&out.join("runs.csv"), report::csv(&Run::HEADER, &rows).as_bytes())?;
    let times: Vec<Vec<String>> = measured
        .timings
        .iter()
        .map(|t| {
            let time = format!("{:.4}", t.milliseconds);
            vec![t.experiment.to_owned(), t.step.to_owned(), t.seed.to_string(), time]
        })
        .collect();
    let header = ["experiment", "step", "seed", "milliseconds"];
    report::write_file(&out.join("timings.csv"), report::csv(&header, &times).as_bytes())
}
