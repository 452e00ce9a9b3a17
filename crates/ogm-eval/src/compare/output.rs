//! Where the results go: CSV, JSON, the report, and the document that quotes it.

use super::args::Args;
use super::record::Run;
use super::{Measured, Verdict, splice};
use crate::report::{self, Report};

/// Writes everything into the output folder and says on the terminal what failed.
pub(super) fn write(args: &Args, measured: &Measured) -> anyhow::Result<Verdict> {
    let report = Report {
        title: "Merging occupancy grid maps: the papers' experiments".to_owned(),
        info: provenance(args),
        sections: measured.sections.clone(),
    };
    report::write_all(&report, &args.out)?;
    let rows: Vec<Vec<String>> = measured.runs.iter().map(Run::cells).collect();
    report::write_file(&args.out.join("runs.csv"), report::csv(&Run::HEADER, &rows).as_bytes())?;
    let times: Vec<Vec<String>> = measured
        .timings
        .iter()
        .map(|t| {
            let time = format!("{:.4}", t.milliseconds);
            vec![t.experiment.to_owned(), t.step.to_owned(), t.seed.to_string(), time]
        })
        .collect();
    let header = ["experiment", "step", "seed", "milliseconds"];
    report::write_file(&args.out.join("timings.csv"), report::csv(&header, &times).as_bytes())?;
    if let Some(document) = &args.splice {
        splice::into_document(document, &report)?;
    }

    let failed: Vec<_> = report.criteria().filter(|(_, criterion)| !criterion.pass).collect();
    for (_, criterion) in &failed {
        println!("FAILED {}: {} (ours: {:.4})", criterion.id, criterion.statement, criterion.ours);
    }
    println!("{}: {}", report.verdict(), args.out.join("report.html").display());
    Ok(if failed.is_empty() { Verdict::Passed } else { Verdict::Failed })
}

/// What was run, on what.
fn provenance(args: &Args) -> Vec<(String, String)> {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let command = std::env::args().skip(1).collect::<Vec<_>>().join(" ");
    [
        ("command", format!("cargo xtask {command}")),
        ("first seed", args.seed.to_string()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("CPU", cpu.unwrap_or_else(|| "unknown".to_owned())),
        ("threads", rayon::current_num_threads().to_string()),
        ("profile", if cfg!(debug_assertions) { "debug" } else { "release" }.to_owned()),
    ]
    .map(|(key, value)| (key.to_owned(), value))
    .to_vec()
}
