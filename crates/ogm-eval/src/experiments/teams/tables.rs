//! The counts of X9.

use ogm_sim::FloorKind;

use super::record::{Answer, Judged, Pair, pairs};
use crate::judge::NEES_95;
use crate::report::Table;
use crate::stats::{median, wilson_ci95};

/// Edges of the bins of probability.
const EDGES: [f64; 6] = [0.9, 0.95, 0.98, 0.99, 0.995, 1.0];

/// "12 of 40, 30 % [18, 45]".
fn share(hits: usize, of: usize) -> String {
    if of == 0 {
        return "–".to_owned();
    }
    let (low, high) = wilson_ci95(hits, of);
    let percent = 100.0 * hits as f64 / of as f64;
    format!("{hits} of {of}, {percent:.1} % [{:.1}, {:.1}]", 100.0 * low, 100.0 * high)
}

fn count(pairs: &[&Pair], holds: impl Fn(&Pair) -> bool) -> usize {
    pairs.iter().filter(|pair| holds(pair)).count()
}

pub(super) fn by_kind(judged: &[Judged]) -> Table {
    let row = |name: &str, holds: &dyn Fn(FloorKind) -> bool| {
        let all = pairs(judged, holds);
        let enough: Vec<&Pair> = all.iter().copied().filter(|pair| pair.shares_enough).collect();
        let teams = judged.iter().filter(|team| holds(team.kind));
        let strangers: Vec<bool> = teams.clone().filter_map(|team| team.stranger).collect();
        let joined = strangers.iter().filter(|&&joined| joined).count();
        vec![
            name.to_owned(),
            teams.count().to_string(),
            share(count(&enough, |pair| pair.alone.is_right()), enough.len()),
            share(count(&enough, |pair| pair.joint.is_right()), enough.len()),
            share(count(&all, |pair| pair.alone.is_wrong()), all.len()),
            share(count(&all, |pair| pair.joint.is_wrong()), all.len()),
            share(joined, strangers.len()),
        ]
    };
    let mut rows: Vec<Vec<String>> =
        FloorKind::ALL.into_iter().map(|kind| row(kind.name(), &|other| other == kind)).collect();
    rows.push(row("all that do not repeat", &|kind| !kind.repeats()));
    rows.push(row("all that repeat", &FloorKind::repeats));
    Table {
        caption: "Pairs placed rightly, of those that share at least 5 m of wall, and wrongly, of \
                  all; teams whose stranger was joined."
            .to_owned(),
        header: [
            "floor",
            "teams",
            "right, pairs alone",
            "right, team",
            "wrong, pairs alone",
            "wrong, team",
            "stranger joined",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows,
    }
}

/// Median displacement and turn of some answers, metres and degrees.
pub(super) fn medians<'a>(answers: impl Iterator<Item = &'a Answer> + Clone) -> Option<(f64, f64)> {
    let errors = answers.filter_map(Answer::right_error);
    let displacements: Vec<f64> = errors.clone().map(|error| error.displacement).collect();
    let turns: Vec<f64> = errors.map(|error| error.turn.to_degrees()).collect();
    Some((median(&displacements)?, median(&turns)?))
}

/// Pairs that both placed rightly.
pub(super) fn placed_by_both(judged: &[Judged]) -> Vec<&Pair> {
    let mut both = pairs(judged, |kind| !kind.repeats());
    both.retain(|pair| pair.shares_enough && pair.alone.is_right() && pair.joint.is_right());
    both
}

pub(super) fn errors(judged: &[Judged]) -> Table {
    let both = placed_by_both(judged);
    let row = |name: &str, found: Option<(f64, f64)>, number: usize| {
        let (metres, degrees) = found.unwrap_or((f64::NAN, f64::NAN));
        vec![
            name.to_owned(),
            number.to_string(),
            crate::report::number(metres),
            crate::report::number(degrees),
        ]
    };
    let plain = pairs(judged, |kind| !kind.repeats());
    let more: Vec<&Pair> = plain
        .into_iter()
        .filter(|pair| !pair.alone.is_placed() && pair.joint.is_right() && pair.shares_enough)
        .collect();
    let alone = medians(both.iter().map(|pair| &pair.alone));
    let joint = medians(both.iter().map(|pair| &pair.joint));
    let added = medians(more.iter().map(|pair| &pair.joint));
    Table {
        caption: "Errors of pairs that were placed rightly, floors that do not repeat.".to_owned(),
        header: ["placed", "pairs", "median, m", "median, °"].map(str::to_owned).to_vec(),
        rows: vec![
            row("by the pair and by the team: the pair", alone, both.len()),
            row("by the pair and by the team: the team", joint, both.len()),
            row("by the team alone", added, more.len()),
        ],
    }
}

/// Errors in units of the covariances that the team gives.
pub(super) fn within(judged: &[Judged]) -> (usize, usize) {
    let plain = pairs(judged, |kind| !kind.repeats());
    let nees: Vec<f64> = plain.iter().filter_map(|pair| pair.nees).collect();
    (nees.iter().filter(|&&nees| nees <= NEES_95).count(), nees.len())
}

pub(super) fn reliability(judged: &[Judged]) -> Table {
    let row = |name: &str, holds: &dyn Fn(FloorKind) -> bool| {
        let placed: Vec<&Pair> =
            pairs(judged, holds).into_iter().filter(|pair| pair.joint.is_placed()).collect();
        EDGES
            .windows(2)
            .map(|edges| {
                let inside = |p: f64| p >= edges[0] && (p < edges[1] || edges[1] == 1.0);
                let bin: Vec<&Pair> = placed
                    .iter()
                    .copied()
                    .filter(|pair| pair.probability.is_some_and(inside))
                    .collect();
                vec![
                    name.to_owned(),
                    format!("{:.3}–{:.3}", edges[0], edges[1]),
                    share(count(&bin, |pair| pair.joint.is_right()), bin.len()),
                ]
            })
            .collect::<Vec<_>>()
    };
    let plain = row("floors that do not repeat", &|kind| !kind.repeats());
    let repeating = row("floors that repeat", &FloorKind::repeats);
    let (inside, of) = within(judged);
    let nees = vec!["covariance".to_owned(), "95 %".to_owned(), share(inside, of)];
    Table {
        caption: "Probability of a placed pair against how often it is right; and errors inside \
                  the 95 % that the joint covariance states."
            .to_owned(),
        header: ["pairs of", "stated", "right"].map(str::to_owned).to_vec(),
        rows: [plain, repeating, vec![nees]].concat(),
    }
}
