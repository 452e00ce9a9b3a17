//! `cargo xtask compare`: parses, runs the experiments, says what failed.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use ogm_eval::compare::{ExperimentId, Options};

use crate::bar::Bar;
use crate::diff::today;

/// Runs the papers' experiments and writes tables, figures and a report.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Run only this experiment; repeat for several.
    #[arg(long, value_parser = experiment(), ignore_case = true)]
    only: Vec<ExperimentId>,
    /// Run every experiment there is.
    #[arg(long, conflicts_with = "only")]
    all: bool,
    /// First seed; run i uses seed + i.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Worlds of X4 and, five times as many, extractions of X3.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    runs: Option<u32>,
    /// A few runs of every experiment, in about a minute on two cores, judged by looser floors.
    #[arg(long)]
    quick: bool,
    /// Where the report goes.
    #[arg(long, default_value = "target/compare")]
    out: PathBuf,
    /// Also run the methods on the map pairs in this folder.
    #[arg(long)]
    pairs: Option<PathBuf>,
    /// Also write the result tables and the picture into this document.
    #[arg(long)]
    splice: Option<PathBuf>,
    /// Also keep the summary in crates/ogm-eval/record, under today's date and this name.
    #[arg(long)]
    record: Option<String>,
}

fn experiment() -> impl TypedValueParser<Value = ExperimentId> {
    let values = ExperimentId::ALL.map(|id| PossibleValue::new(id.name()).help(id.about()));
    PossibleValuesParser::new(values).try_map(|name| {
        let mut all = ExperimentId::ALL.into_iter();
        all.find(|id| id.name().eq_ignore_ascii_case(&name)).ok_or("no such experiment")
    })
}

impl Args {
    /// The experiments that this command line asks for.
    fn experiments(&self) -> Vec<ExperimentId> {
        if self.only.is_empty() {
            let every = ExperimentId::ALL.into_iter();
            every.filter(|id| self.all || self.quick || !id.is_on_request()).collect()
        } else {
            self.only.clone()
        }
    }
}

pub(crate) fn run(args: Args) -> anyhow::Result<ExitCode> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let options = Options {
        experiments: args.experiments(),
        seed: args.seed,
        runs: args.runs,
        quick: args.quick,
        pairs: args.pairs,
        command: format!("cargo xtask {}", words.join(" ")),
        watch: Arc::new(Bar::default()),
    };
    let comparison = ogm_eval::compare::run(&options)?;
    comparison.write(&args.out)?;
    if let Some(document) = &args.splice {
        comparison.quote_in(document)?;
    }
    if let Some(name) = &args.record {
        let record = comparison.record(&today());
        let path = record.path(name)?;
        record.write(&path)?;
        println!("recorded in {}", path.display());
    }
    let failures = comparison.failures();
    for failure in &failures {
        println!("FAILED {failure}");
    }
    println!("{}: {}", comparison.verdict(), args.out.join("report.html").display());
    Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
