//! `cargo xtask compare`: the papers' experiments, the paper's value beside ours.

use std::path::Path;

use crate::experiments::{
    bends, labelled, methods, random_walk, real_pairs, robots, segments, teams, wall_direction,
    worked_tables,
};
use crate::measured::Measured;
use crate::output;
use crate::record::Record;
use crate::report::{self, Report};

pub use crate::options::{ExperimentId, Options};

/// What came of the experiments.
#[derive(Debug)]
pub struct Comparison {
    report: Report,
    measured: Measured,
}

/// Runs what is asked for.
///
/// # Errors
/// A debug build, a seed over 2³², an experiment that cannot be run, pairs that cannot be read.
pub fn run(options: &Options) -> anyhow::Result<Comparison> {
    options.check()?;
    let mut all = Measured::default();
    for experiment in &options.experiments {
        let measured = match experiment {
            ExperimentId::X1 => worked_tables::grouping_of_walls(),
            ExperimentId::X2 => worked_tables::choice_of_tags()?,
            ExperimentId::X3 => wall_direction::measure(options)?,
            ExperimentId::X4 => methods::measure(options)?,
            ExperimentId::X5 => random_walk::measure(options)?,
            ExperimentId::X6 => segments::measure(options)?,
            ExperimentId::X7 => labelled::measure(options)?,
            ExperimentId::X8 => robots::measure(options)?,
            ExperimentId::X9 => teams::measure(options)?,
            ExperimentId::X10 => bends::measure(options)?,
        };
        all.extend(measured);
    }
    if let Some(folder) = &options.pairs {
        all.extend(real_pairs::measure(options, folder)?);
        if options.experiments.contains(&ExperimentId::X6) {
            all.extend(segments::measure_pairs(options, folder)?);
        }
        if options.experiments.contains(&ExperimentId::X10) {
            all.extend(bends::measure_pairs(options, folder)?);
        }
    }
    let report = Report {
        title: "Merging occupancy grid maps: the papers' experiments".to_owned(),
        info: provenance(options),
        sections: std::mem::take(&mut all.sections),
    };
    Ok(Comparison { report, measured: all })
}

impl Comparison {
    /// Writes report, figures, summary, runs and times into a folder, which is created.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, out: &Path) -> anyhow::Result<()> {
        output::write(&self.report, &self.measured, out)
    }

    /// Puts the result tables and their picture into a document that quotes them.
    ///
    /// # Errors
    /// A document that cannot be read or written, or has none of the markers.
    pub fn quote_in(&self, document: &Path) -> anyhow::Result<()> {
        report::quote_in(document, &self.report)
    }

    /// What is kept of it, as of `date`, "2026-11-25".
    #[must_use]
    pub fn record(&self, date: &str) -> Record {
        Record::of(&self.report, &self.measured.runs, date)
    }

    /// One line for each criterion that does not hold.
    #[must_use]
    pub fn failures(&self) -> Vec<String> {
        let failed = self.report.criteria().filter(|(_, criterion)| !criterion.pass);
        let line = failed.map(|(_, criterion)| {
            format!("{}: {} (ours: {:.4})", criterion.id, criterion.statement, criterion.ours)
        });
        line.collect()
    }

    /// "14 of 15 criteria hold".
    #[must_use]
    pub fn verdict(&self) -> String {
        self.report.verdict()
    }
}

/// What was run, on what.
fn provenance(options: &Options) -> Vec<(String, String)> {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    [
        ("command", options.command.clone()),
        ("first seed", options.seed.to_string()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("CPU", cpu.unwrap_or_else(|| "unknown".to_owned())),
        ("threads", rayon::current_num_threads().to_string()),
        ("profile", if cfg!(debug_assertions) { "debug" } else { "release" }.to_owned()),
    ]
    .map(|(key, value)| (key.to_owned(), value))
    .to_vec()
}
