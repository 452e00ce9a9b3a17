//! The proof: reproduces the papers' tables and checks the shape of the workspace.

mod compare;
mod draw;
#[cfg(test)]
mod layers;
mod report;
mod stats;
#[cfg(test)]
mod tidy;

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
}

fn main() -> ExitCode {
    let Task::Compare(args) = Cli::parse().task;
    match compare::run(&args) {
        Ok(compare::Verdict::Passed) => ExitCode::SUCCESS,
        Ok(compare::Verdict::Failed) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
