//! `cargo xtask compare`: the papers' experiments, the paper's value beside ours.

mod args;
mod direction_figures;
mod evaluation;
mod format;
mod labelled;
mod labelled_curve;
mod labelled_tables;
mod method_charts;
mod method_criteria;
mod method_figures;
mod method_tables;
mod methods;
mod output;
mod pair_figures;
mod pair_tags;
mod pairs;
mod random_walk;
mod random_walk_cases;
mod random_walk_figures;
mod random_walk_pairs;
mod random_walk_tables;
mod record;
mod segment_figures;
mod segment_merge;
mod segment_search;
mod splice;
mod team_world;
mod wall_direction;
mod worked_tables;
mod worlds;

use indicatif::{ProgressBar, ProgressStyle};

use crate::report::Section;

pub use args::Args;
use args::ExperimentId;
use record::Run;

/// Whether every criterion that was judged holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// All of them.
    Passed,
    /// All but some.
    Failed,
}

/// What an experiment hands to the report.
#[derive(Debug, Default)]
struct Measured {
    sections: Vec<Section>,
    runs: Vec<Run>,
    timings: Vec<Timing>,
}

/// Wall time of one step of one run; never in a result file.
#[derive(Debug, Clone)]
struct Timing {
    experiment: &'static str,
    step: &'static str,
    seed: u64,
    milliseconds: f64,
}

/// Runs what the command line asks for and writes the report.
pub fn run(args: &Args) -> anyhow::Result<Verdict> {
    args.check()?;
    let mut all = Measured::default();
    for experiment in args.experiments() {
        let measured = match experiment {
            ExperimentId::X1 => worked_tables::grouping_of_walls(),
            ExperimentId::X2 => worked_tables::choice_of_tags()?,
            ExperimentId::X3 => wall_direction::run(args)?,
            ExperimentId::X4 => methods::run(args)?,
            ExperimentId::X5 => random_walk::run(args)?,
            ExperimentId::X6 => segment_merge::run(args)?,
            ExperimentId::X7 => labelled::run(args)?,
        };
        all.extend(measured);
    }
    if let Some(folder) = &args.pairs {
        all.extend(pairs::run(args, folder)?);
        if args.experiments().contains(&ExperimentId::X6) {
            all.extend(segment_search::run_pairs(args, folder)?);
        }
    }
    output::write(args, &all)
}

impl Measured {
    fn of_section(section: Section) -> Self {
        Self { sections: vec![section], ..Self::default() }
    }

    fn extend(&mut self, other: Self) {
        self.sections.extend(other.sections);
        self.runs.extend(other.runs);
        self.timings.extend(other.timings);
    }
}

/// A bar on a terminal, nothing in a pipe.
fn progress(label: &'static str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:24} {wide_bar} {pos}/{len} {eta}");
    let bar = ProgressBar::new(length).with_message(label);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
