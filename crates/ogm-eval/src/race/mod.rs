//! `cargo xtask race`: how long `ogm align` takes and how often it is right, beside other tools on
//! the same pairs in the same run.

mod answer;
mod contestant;
mod estate;
mod pair;
mod score;
mod tables;

use std::path::{Path, PathBuf};

use anyhow::Context;

use crate::map_pair::folders_of_pairs;
use crate::report::{self, Table};
use contestant::Contestant;
use pair::{Pair, read_pairs};
use score::Score;

/// Times the command `ogm` and other tools on the same map pairs, and scores their answers.
#[derive(Debug, clap::Args)]
pub struct Args {
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

/// What each command made of one pair; `None` where it did not take part.
#[derive(Debug)]
struct Raced {
    pair: Pair,
    outcomes: Vec<Option<Outcome>>,
}

/// What one command made of one pair.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    score: Score,
    /// Least CPU seconds of the process, start-up included.
    cpu_s: f64,
    /// Least CPU seconds without start-up and reading, if the command counts them itself.
    own_cpu_s: Option<f64>,
}

/// Runs all commands on all pairs and prints the tables.
pub fn run(args: &Args) -> anyhow::Result<()> {
    let mut contestants = vec![Contestant::new("ogm align", &args.ours)?];
    contestants.extend(args.peers.iter().cloned());
    let real = read_pairs(&folders_of_pairs(&args.pairs)?)?;
    let synthetic = read_pairs(&estate::write_pairs(&args.out)?)?;
    let race = |pairs: Vec<Pair>, peer_cells: usize| -> anyhow::Result<Vec<Raced>> {
        let pairs = pairs.into_iter();
        pairs.map(|pair| race_on(pair, &contestants, args.repeat, peer_cells)).collect()
    };
    let sized = race(synthetic, args.peer_cells)?;
    let real = race(real, usize::MAX)?;

    let names: Vec<&str> = contestants.iter().map(|one| one.name.as_str()).collect();
    let tables = tables::all(&names, &real, &sized);
    let text = document_text(&tables);
    println!("{text}");
    if let Some(document) = &args.splice {
        splice_into(document, &text)?;
    }
    Ok(())
}

/// One pair: the commands take turns, so that whatever else the machine does hits all alike.
fn race_on(
    pair: Pair,
    contestants: &[Contestant],
    repeat: u32,
    peer_cells: usize,
) -> anyhow::Result<Raced> {
    let mut outcomes: Vec<Option<Outcome>> = vec![None; contestants.len()];
    for _ in 0..repeat {
        for (place, contestant) in contestants.iter().enumerate() {
            if place > 0 && pair.cells.iter().any(|&cells| cells > peer_cells) {
                continue;
            }
            let run = contestant.run(&pair.files)?;
            let this = Outcome {
                score: Score::of(run.answer.as_ref(), pair.truth.as_ref()),
                cpu_s: run.cpu_s,
                own_cpu_s: run.answer.and_then(|answer| answer.own_cpu_s),
            };
            let before = outcomes[place];
            outcomes[place] = Some(before.map_or(this, |before| before.and(this)));
        }
    }
    let raced = Raced { pair, outcomes };
    eprintln!("{}", tables::line(&raced));
    Ok(raced)
}

impl Outcome {
    /// Two runs as one: the shorter times and the first score, but a crash is a crash.
    fn and(self, next: Self) -> Self {
        let crashed = next.score == Score::Crash;
        Self {
            score: if crashed { Score::Crash } else { self.score },
            cpu_s: self.cpu_s.min(next.cpu_s),
            own_cpu_s: self.own_cpu_s.zip(next.own_cpu_s).map(|(a, b)| a.min(b)),
        }
    }
}

fn document_text(tables: &[(&str, Table)]) -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let machine = format!("{} with {cores} cores; one thread each.", std::env::consts::ARCH);
    let mut text = format!("Measured on {machine}\n");
    for (title, table) in tables {
        text.push_str(&format!("\n### {title}\n\n{}", report::markdown_table(table)));
        text.push_str(&format!("\n{}\n", table.caption));
    }
    text
}

fn splice_into(document: &Path, text: &str) -> anyhow::Result<()> {
    let before = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let words = std::env::args().skip(1).map(|word| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
        if word.chars().all(plain) { word } else { format!("'{word}'") }
    });
    let command = format!("cargo xtask {}", words.collect::<Vec<_>>().join(" "));
    let after = report::splice(&before, "race", text, &command)
        .with_context(|| format!("in {}", document.display()))?;
    report::write_file(document, after.as_bytes())
}
