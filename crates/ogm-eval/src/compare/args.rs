//! The command line of `compare`, and what follows from it.

use std::path::PathBuf;

use anyhow::bail;
use clap::ValueEnum;

/// Runs the papers' experiments and writes tables, figures and a report.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Run only this experiment; repeat for several.
    #[arg(long, value_enum, ignore_case = true)]
    pub(crate) only: Vec<ExperimentId>,
    /// Run every experiment there is.
    #[arg(long, conflicts_with = "only")]
    pub(crate) all: bool,
    /// First seed; run i uses seed + i.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Worlds of X4 and, five times as many, extractions of X3.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: Option<u32>,
    /// A few runs of everything, under 30 s; criteria that need many runs are not judged.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Where the report goes.
    #[arg(long, default_value = "target/compare")]
    pub(crate) out: PathBuf,
    /// Also run the methods on the map pairs in this folder.
    #[arg(long)]
    pub(crate) pairs: Option<PathBuf>,
    /// Also write the result tables and the picture into this document.
    #[arg(long)]
    pub(crate) splice: Option<PathBuf>,
}

/// The experiments, by the names that the report uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExperimentId {
    /// The worked grouping of walls (Tables 1 and 2).
    X1,
    /// The worked choice of tags (Table 3).
    X2,
    /// The direction of a building over many extractions (section 5.1).
    X3,
    /// The three methods on simulated worlds (Table 4).
    X4,
    /// Stochastic merging on simulated rescue maps (Carpin and Birk); only on request.
    X5,
    /// Wall segments and the Radon transform; runs only when asked for.
    X6,
    /// The matcher on labelled pairs of maps, and whether its probability holds; only on request.
    X7,
}

impl Args {
    /// The experiments that this command line asks for.
    pub(crate) fn experiments(&self) -> Vec<ExperimentId> {
        if self.only.is_empty() {
            let on_request = [ExperimentId::X5, ExperimentId::X6, ExperimentId::X7];
            let every = ExperimentId::value_variants().iter().copied();
            every.filter(|id| self.all || !on_request.contains(id)).collect()
        } else {
            self.only.clone()
        }
    }

    /// Worlds for the default methods of X4.
    pub(crate) fn worlds(&self) -> u64 {
        match (self.runs, self.quick) {
            (Some(runs), _) => runs.into(),
            (None, true) => 3,
            (None, false) => 200,
        }
    }

    /// Worlds for the other variants of X4.
    pub(crate) fn variant_worlds(&self) -> u64 {
        self.worlds().min(50)
    }

    /// Extractions of one map in X3.
    pub(crate) fn extractions(&self) -> u64 {
        if self.quick && self.runs.is_none() { 20 } else { 5 * self.worlds() }
    }

    /// Refuses what would mislead.
    pub(crate) fn check(&self) -> anyhow::Result<()> {
        if cfg!(debug_assertions) {
            bail!("compare needs a release build: run `cargo xtask compare`");
        }
        if self.seed > u64::from(u32::MAX) {
            bail!("the first seed is {}; use one up to {}", self.seed, u32::MAX);
        }
        Ok(())
    }
}
