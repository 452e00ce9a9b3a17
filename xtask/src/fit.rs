//! `cargo xtask fit`: draws, fits, writes the weights into the matcher.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use ogm_eval::fit::{FitOptions, fit};

use crate::bar::Bar;

/// Fits the weights of the matcher on labelled pairs and writes them into its source.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// First seed; the experiments draw theirs from 3 000 000 on.
    #[arg(long, default_value_t = 400_000, value_parser = clap::value_parser!(u64).range(..3_000_000))]
    seed: u64,
    /// Seeds of each kind of floor and relation.
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..600_000))]
    count: u64,
    /// The source file.
    #[arg(long, default_value = "crates/grid-match/src/weights.rs")]
    out: PathBuf,
}

pub(crate) fn run(args: Args) -> anyhow::Result<ExitCode> {
    let options =
        FitOptions { seed: args.seed, count: args.count, watch: Arc::new(Bar::default()) };
    let fitted = fit(&options)?;
    fitted.write(&args.out)?;
    println!("{}\nwritten to {}", fitted.summary, args.out.display());
    Ok(ExitCode::SUCCESS)
}
