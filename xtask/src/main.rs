//! The proof: reproduces the papers' tables and checks the shape of the workspace.

#![expect(
    clippy::disallowed_methods,
    reason = "this is where files are written and time is measured"
)]
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "it talks to a person at a terminal"
)]

mod compare;
mod draw;
mod fixtures;
#[cfg(test)]
mod layers;
mod map_pair;
mod race;
mod report;
mod stats;
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
        Task::Compare(args) => compare::run(&args),
        Task::Race(args) => race::run(&args).map(|()| compare::Verdict::Passed),
        Task::Fixtures { out } => fixtures::write(&out).map(|()| compare::Verdict::Passed),
    };
    match done {
        Ok(compare::Verdict::Passed) => ExitCode::SUCCESS,
        Ok(compare::Verdict::Failed) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
