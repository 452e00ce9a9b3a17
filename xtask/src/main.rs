//! Tasks of the workspace: thin fronts over the proof, and the checks of the workspace's shape.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "it talks to a person at a terminal"
)]

mod bar;
mod compare;
mod diff;
mod fit;
mod fleet;
mod fusion;
#[cfg(test)]
mod layers;
mod race;
#[cfg(test)]
mod tidy;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Tasks of the workspace.
#[derive(Debug, Parser)]
#[command(bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Runs the papers' experiments and writes tables, figures and a report.
    Compare(compare::Args),
    /// Shows what changed between two records of `compare`; fails if a criterion no longer holds.
    Diff(diff::Args),
    /// Fits the weights of the matcher and writes them into its source.
    Fit(fit::Args),
    /// Measures what an index of map signatures saves a fleet, and what it misses.
    Fleet(fleet::Args),
    /// Fuses real map pairs and measures what became of their walls.
    Fusion(fusion::Args),
    /// Times the command `ogm` and other tools on the same map pairs, and scores their answers.
    Race(race::Args),
    /// Writes the example maps and tag logs into a folder.
    Fixtures {
        /// Where to.
        #[arg(long, default_value = "fixtures/plan-a")]
        out: PathBuf,
    },
}

fn main() -> ExitCode {
    let done = match Cli::parse().task {
        Task::Compare(args) => compare::run(args),
        Task::Diff(args) => diff::run(&args),
        Task::Fit(args) => fit::run(args),
        Task::Fleet(args) => fleet::run(&args),
        Task::Fusion(args) => fusion::run(&args),
        Task::Race(args) => race::run(args),
        Task::Fixtures { out } => ogm_eval::fixtures::write(&out).map(|()| ExitCode::SUCCESS),
    };
    done.unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        ExitCode::from(2)
    })
}
