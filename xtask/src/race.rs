//! `cargo xtask race`: parses, runs the race, prints its tables.

use std::path::PathBuf;
use std::process::ExitCode;

use ogm_eval::race::{self, Contestant, Options};

/// Times the command `ogm` and other tools on the same map pairs, and scores their answers.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Folder of real pairs: subfolders with a.yaml, b.yaml and truth.json.
    #[arg(long)]
    pairs: PathBuf,
    /// Our command, split at white space.
    #[arg(long, default_value = "target/release/ogm align {a} {b} --json")]
    ours: String,
    /// Another tool as NAME=COMMAND with {a}, {b} (YAML) and {a_pgm}, {b_pgm} (image); repeat for
    /// several. It prints JSON as `ogm align` does, or ok, dx, dy, theta_deg and cpu_seconds.
    #[arg(long = "peer", value_parser = Contestant::parse)]
    peers: Vec<Contestant>,
    /// Runs of each command on each pair; the least time counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Largest synthetic map, in cells, that peers get too.
    #[arg(long, default_value_t = 4_000_000)]
    peer_cells: usize,
    /// Where the synthetic pairs go.
    #[arg(long, default_value = "target/race/pairs")]
    out: PathBuf,
    /// Also write the tables into this document.
    #[arg(long)]
    splice: Option<PathBuf>,
}

pub(crate) fn run(args: Args) -> anyhow::Result<ExitCode> {
    let options = Options {
        pairs: args.pairs,
        ours: args.ours,
        peers: args.peers,
        repeat: args.repeat,
        peer_cells: args.peer_cells,
        out: args.out,
    };
    let text = race::run(&options, &|line| eprintln!("{line}"))?;
    println!("{text}");
    if let Some(document) = &args.splice {
        race::splice_into(document, &text, &command())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// This command line, quoted for a shell.
fn command() -> String {
    let words = std::env::args().skip(1).map(|word| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
        if word.chars().all(plain) { word } else { format!("'{word}'") }
    });
    format!("cargo xtask {}", words.collect::<Vec<_>>().join(" "))
}
