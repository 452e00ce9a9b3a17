//! `cargo xtask race`: how long `ogm align` takes and how often it is right, beside other tools on
//! the same pairs in the same run.

mod answer;
mod contestant;
mod record;
mod tables;

use std::path::{Path, PathBuf};

use anyhow::Context;

use crate::cases::estate;
use crate::cases::map_pair::folders_of_pairs;
use crate::judge::Verdict;
use crate::report::{self, Table};
use record::{Outcome, Pair, Raced, smallest_first};

pub use contestant::Contestant;

/// Who runs on what.
#[derive(Debug, Clone)]
pub struct Options {
    /// Folder of real pairs: subfolders with a.yaml, b.yaml and truth.json.
    pub pairs: PathBuf,
    /// Our command, split at white space.
    pub ours: String,
    /// Other tools.
    pub peers: Vec<Contestant>,
    /// Runs of each command on each pair; the least time counts.
    pub repeat: u32,
    /// Largest synthetic map, in cells, that peers get too.
    pub peer_cells: usize,
    /// Where the synthetic pairs go.
    pub out: PathBuf,
}

/// Runs all commands on all pairs and gives the tables as text; `say` gets a line for each pair.
///
/// # Errors
/// Pairs that cannot be read or written, and a program that cannot be started.
pub fn run(options: &Options, say: &dyn Fn(&str)) -> anyhow::Result<String> {
    let mut contestants = vec![Contestant::new("ogm align", &options.ours)?];
    contestants.extend(options.peers.iter().cloned());
    let real = smallest_first(&folders_of_pairs(&options.pairs)?)?;
    let synthetic = smallest_first(&estate::write_pairs(&options.out)?)?;
    let race = |pairs: Vec<Pair>, peer_cells: usize| -> anyhow::Result<Vec<Raced>> {
        let pairs = pairs.into_iter();
        let raced = pairs.map(|pair| {
            let raced = race_on(pair, &contestants, (options.repeat, peer_cells), say)?;
            say(&tables::line(&raced));
            Ok(raced)
        });
        raced.collect()
    };
    let sized = race(synthetic, options.peer_cells)?;
    let real = race(real, usize::MAX)?;

    let names: Vec<&str> = contestants.iter().map(|one| one.name.as_str()).collect();
    Ok(document_text(&tables::all(&names, &real, &sized)))
}

/// One pair: the commands take turns, so that whatever else the machine does hits all alike.
fn race_on(
    pair: Pair,
    contestants: &[Contestant],
    (repeat, peer_cells): (u32, usize),
    say: &dyn Fn(&str),
) -> anyhow::Result<Raced> {
    let mut outcomes: Vec<Option<Outcome>> = vec![None; contestants.len()];
    for _ in 0..repeat {
        for (place, contestant) in contestants.iter().enumerate() {
            if place > 0 && pair.cells.iter().any(|&cells| cells > peer_cells) {
                continue;
            }
            let run = contestant.run(&pair.files)?;
            if let Some(complaint) = &run.complaint {
                say(complaint);
            }
            let verdict = run.answer.as_ref().map_or(Verdict::Crash, |answer| {
                Verdict::of(answer.target_from_source.as_ref(), pair.truth.as_ref())
            });
            let this = Outcome {
                verdict,
                cpu_s: run.cpu_s,
                own_cpu_s: run.answer.and_then(|answer| answer.own_cpu_s),
            };
            let before = outcomes[place];
            outcomes[place] = Some(before.map_or(this, |before| before.and(this)));
        }
    }
    Ok(Raced { pair, outcomes })
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

/// Puts the tables into a document, under the command that made them.
///
/// # Errors
/// A document that cannot be read or written, or has no markers.
pub fn splice_into(document: &Path, text: &str, command: &str) -> anyhow::Result<()> {
    let before = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let after = report::splice(&before, "race", text, command)
        .with_context(|| format!("in {}", document.display()))?;
    report::write_file(document, after.as_bytes())
}
