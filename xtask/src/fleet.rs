//! `cargo xtask fleet`: parses, measures, prints its table.

use std::path::PathBuf;
use std::process::ExitCode;

use ogm_eval::fleet;

/// Measures what an index of map signatures saves a fleet, and what it misses.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Floors, with five robots each.
    #[arg(long, default_value_t = 60)]
    floors: usize,
    /// Seed of the first floor.
    #[arg(long, default_value_t = 9_100_000)]
    seed: u64,
    /// Also write the table into this document.
    #[arg(long)]
    splice: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let text = fleet::run(args.floors, args.seed)?;
    println!("{text}");
    if let Some(document) = &args.splice {
        let command = format!("cargo xtask fleet --floors {} --seed {}", args.floors, args.seed);
        fleet::splice_into(document, &text, &command)?;
    }
    Ok(ExitCode::SUCCESS)
}
