//! `cargo xtask fusion`: parses, measures, prints its tables.

use std::path::PathBuf;
use std::process::ExitCode;

use ogm_eval::fusion;

/// Fuses real map pairs and measures what became of their walls.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Folder of real pairs: subfolders with a.yaml, b.yaml and truth.json; repeat for several.
    #[arg(long, required = true)]
    pairs: Vec<PathBuf>,
    /// Also write the tables into this document.
    #[arg(long)]
    splice: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let text = fusion::run(&args.pairs)?;
    println!("{text}");
    if let Some(document) = &args.splice {
        fusion::splice_into(document, &text, "cargo xtask fusion --pairs FOLDER --pairs FOLDER")?;
    }
    Ok(ExitCode::SUCCESS)
}
