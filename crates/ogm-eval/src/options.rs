//! What a run of the experiments is asked for, and what follows from it.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{bail, ensure};

use crate::watch::Watch;

/// What [`compare::run`](crate::compare::run) does.
#[derive(Debug, Clone)]
pub struct Options {
    /// The experiments, in the order of the report.
    pub experiments: Vec<ExperimentId>,
    /// First seed; run i uses seed + i.
    pub seed: u64,
    /// Worlds of X4 and X5, teams of X8, indices of X7, X9 and X10 and, five times as many,
    /// extractions of X3.
    pub runs: Option<u32>,
    /// A few runs, judged by looser floors.
    pub quick: bool,
    /// A folder of map pairs to run the methods on too.
    pub pairs: Option<PathBuf>,
    /// How this run can be repeated: the command line.
    pub command: String,
    /// Who hears how far it has come.
    pub watch: Arc<dyn Watch>,
}

/// The experiments, by the names that the report uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExperimentId {
    /// The worked grouping of walls.
    X1,
    /// The worked choice of tags.
    X2,
    /// The direction of a building.
    X3,
    /// The three methods on simulated worlds.
    X4,
    /// Stochastic merging on simulated rescue maps.
    X5,
    /// Wall segments and the Radon transform.
    X6,
    /// The matcher on labelled pairs.
    X7,
    /// One robot's filters, and three that share their maps.
    X8,
    /// Teams of maps.
    X9,
    /// Bent maps made straight.
    X10,
}

impl ExperimentId {
    /// Every experiment, in the order of the report.
    pub const ALL: [Self; 10] = [
        Self::X1,
        Self::X2,
        Self::X3,
        Self::X4,
        Self::X5,
        Self::X6,
        Self::X7,
        Self::X8,
        Self::X9,
        Self::X10,
    ];

    /// Its name on a command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::X1 => "x1",
            Self::X2 => "x2",
            Self::X3 => "x3",
            Self::X4 => "x4",
            Self::X5 => "x5",
            Self::X6 => "x6",
            Self::X7 => "x7",
            Self::X8 => "x8",
            Self::X9 => "x9",
            Self::X10 => "x10",
        }
    }

    /// What it is about, on one line.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Self::X1 => "The worked grouping of walls (Tables 1 and 2)",
            Self::X2 => "The worked choice of tags (Table 3)",
            Self::X3 => "The direction of a building over many extractions (section 5.1)",
            Self::X4 => "The three methods on simulated worlds (Table 4)",
            Self::X5 => {
                "Stochastic merging on simulated rescue maps (Carpin and Birk); only on request"
            }
            Self::X6 => "Wall segments and the Radon transform; runs only when asked for",
            Self::X7 => {
                "The matcher on labelled pairs of maps, and whether its probability holds; only on \
                 request"
            }
            Self::X8 => {
                "Robots that place themselves, and three that share their maps (Saeedi et al.)"
            }
            Self::X9 => "Teams of maps, pair by pair and together; only on request",
            Self::X10 => "Bent maps made straight; only on request",
        }
    }

    /// Whether it runs only when asked for: it takes minutes with all its runs.
    #[must_use]
    pub fn is_on_request(self) -> bool {
        matches!(self, Self::X5 | Self::X6 | Self::X7 | Self::X9 | Self::X10)
    }
}

impl Options {
    /// Refuses what would mislead.
    pub(crate) fn check(&self) -> anyhow::Result<()> {
        if cfg!(debug_assertions) {
            bail!("compare needs a release build: run `cargo xtask compare`");
        }
        let (seed, limit) = (self.seed, u64::from(u32::MAX));
        ensure!(seed <= limit, "the first seed is {seed}; use one up to {limit}");
        Ok(())
    }

    /// `runs` if they are given, else a few with `quick` and else `all`.
    pub(crate) fn count(&self, quick: u64, all: u64) -> u64 {
        self.runs.map_or(if self.quick { quick } else { all }, u64::from)
    }
}
