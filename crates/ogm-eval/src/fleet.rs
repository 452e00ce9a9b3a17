//! `cargo xtask fleet`: what an index of map signatures saves a fleet of many robots, and what it
//! misses.

use std::path::Path;
use std::time::Instant;

use anyhow::Context;
use grid_match::{MatchParams, PreparedMap, candidate_pairs, match_prepared};
use ogm_core::OccupancyGrid;
use ogm_sim::{FloorKind, LabelledTeam, labelled_team};
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::report::{self, Table};

/// Robots a floor.
const ROBOTS: usize = 5;
/// Pairs that share this much should be found.
const SHARED: f64 = 0.35;
/// Pairs that are timed, spread evenly over all.
const TIMED: usize = 200;
/// Partners of each map.
const PARTNERS: [usize; 5] = [5, 10, 20, 40, 80];

/// Draws floors of all kinds by `seed` with five robots each, and gives what was measured as text.
///
/// # Errors
/// A floor whose maps cannot be prepared.
pub fn run(floors: usize, seed: u64) -> anyhow::Result<String> {
    let kinds = FloorKind::ALL;
    let teams: Vec<LabelledTeam> = (0..floors)
        .into_par_iter()
        .filter_map(|floor| {
            labelled_team(kinds[floor % kinds.len()], ROBOTS, false, seed + floor as u64).ok()
        })
        .collect();
    let maps: Vec<&OccupancyGrid> = teams.iter().flat_map(|team| &team.maps).collect();
    anyhow::ensure!(maps.len() > PARTNERS[0], "{} maps are no fleet", maps.len());
    let floor_of = |map: usize| map / ROBOTS;
    let thresholds = MatchParams::default().thresholds;
    let prepared = maps.par_iter().map(|map| PreparedMap::new(map, &thresholds, &()));
    let prepared: Vec<PreparedMap> = prepared.collect::<Result<_, _>>()?;

    let all: Vec<(usize, usize)> =
        (0..maps.len()).flat_map(|a| (a + 1..maps.len()).map(move |b| (a, b))).collect();
    let shared = all.iter().copied().filter(|&(a, b)| {
        let same = floor_of(a) == floor_of(b);
        let truth = teams[floor_of(a)].truth(a % ROBOTS, b % ROBOTS);
        same && truth.is_some_and(|truth| truth.overlap >= SHARED)
    });
    let shared: Vec<(usize, usize)> = shared.collect();

    let timed: Vec<_> = all.iter().step_by((all.len() / TIMED).max(1)).collect();
    let start = Instant::now();
    for &&(a, b) in &timed {
        match_prepared(&prepared[a], &prepared[b], &MatchParams::default(), &())?;
    }
    let pair_s = start.elapsed().as_secs_f64() / timed.len() as f64;
    let start = Instant::now();
    let signatures: Vec<_> = prepared.iter().map(PreparedMap::signature).collect();
    let signature_s = start.elapsed().as_secs_f64() / maps.len() as f64;

    let mut rows = Vec::new();
    for partners in PARTNERS.into_iter().filter(|&partners| partners < maps.len()) {
        let start = Instant::now();
        let proposed = candidate_pairs(&signatures, partners);
        let index_s = start.elapsed().as_secs_f64();
        let found = shared.iter().filter(|pair| proposed.binary_search(pair).is_ok()).count();
        rows.push(vec![
            partners.to_string(),
            proposed.len().to_string(),
            format!("{:.1}", 100.0 * proposed.len() as f64 / all.len() as f64),
            format!(
                "{found} of {}, {:.0} %",
                shared.len(),
                100.0 * found as f64 / shared.len() as f64
            ),
            format!("{index_s:.2}"),
            format!("{:.0}", pair_s * proposed.len() as f64),
        ]);
    }
    let header = [
        "partners a map",
        "pairs",
        "% of all",
        "sharing pairs among them",
        "index, s",
        "matching, s",
    ];
    let table = Table {
        header: header.map(str::to_owned).to_vec(),
        rows,
        caption: format!(
            "{} maps of {} floors; {} pairs, of which {} share at least {:.0} % of what the \
             smaller map knows. On one core a signature takes {:.1} ms; with {} threads a pair \
             takes {:.0} ms.",
            maps.len(),
            teams.len(),
            all.len(),
            shared.len(),
            100.0 * SHARED,
            1e3 * signature_s,
            rayon::current_num_threads(),
            1e3 * pair_s,
        ),
    };
    Ok(format!("\n{}\n{}\n", report::markdown_table(&table), table.caption))
}

/// Puts the table into a document, under the command that made it.
///
/// # Errors
/// A document that cannot be read or written, or has no markers.
pub fn splice_into(document: &Path, text: &str, command: &str) -> anyhow::Result<()> {
    let before = std::fs::read_to_string(document)
        .with_context(|| format!("cannot read {}", document.display()))?;
    let after = report::splice(&before, "fleet", text, command)
        .with_context(|| format!("in {}", document.display()))?;
    report::write_file(document, after.as_bytes())
}
