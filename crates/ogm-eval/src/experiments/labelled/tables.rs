//! The counts of X7.

use ogm_sim::{FloorKind, MapStyle, Relation};

use super::record::{Judged, cells_off, count, to_merge};
use crate::judge::NEES_95;
use crate::report::Table;
use crate::stats::{median, wilson_ci95};

const BANDS: [[f64; 2]; 5] = [[0.15, 0.25], [0.25, 0.35], [0.35, 0.5], [0.5, 0.7], [0.7, 1.0]];

/// "12 of 40, 30 % [18, 45]".
fn share(hits: usize, of: usize) -> String {
    if of == 0 {
        return "–".to_owned();
    }
    let (low, high) = wilson_ci95(hits, of);
    let percent = 100.0 * hits as f64 / of as f64;
    format!("{hits} of {of}, {percent:.1} % [{:.1}, {:.1}]", 100.0 * low, 100.0 * high)
}

/// Best pose right, right pose listed, merged, merged rightly.
fn columns(pairs: &[&Judged]) -> Vec<String> {
    let merged = count(pairs, Judged::is_merged);
    let rightly = count(pairs, |one| one.is_merged() && one.is_right());
    vec![
        pairs.len().to_string(),
        share(count(pairs, Judged::is_right), pairs.len()),
        share(count(pairs, |one| one.is_listed), pairs.len()),
        share(merged, pairs.len()),
        share(rightly, merged),
    ]
}

const COLUMNS: [&str; 5] =
    ["pairs", "best pose right", "right pose listed", "merged", "right of the merged"];

fn header(first: &str) -> Vec<String> {
    [first].iter().chain(&COLUMNS).map(|&name| name.to_owned()).collect()
}

pub(super) fn by_kind(judged: &[Judged], drawn: usize) -> Table {
    let row = |name: &str, holds: &dyn Fn(FloorKind) -> bool| {
        let pairs = to_merge(judged, |one| holds(one.kind));
        [vec![name.to_owned()], columns(&pairs)].concat()
    };
    let mut rows: Vec<Vec<String>> =
        FloorKind::ALL.into_iter().map(|kind| row(kind.name(), &|other| other == kind)).collect();
    rows.push(row("all that do not repeat", &|kind| !kind.repeats()));
    rows.push(row("all that repeat", &FloorKind::repeats));
    let missing = drawn - judged.len();
    Table {
        caption: format!(
            "Pairs to merge, by the kind of floor; shares with their 95 % interval. Of {drawn} \
             pairs drawn, {missing} did not come about: the floor has no two parts as wanted."
        ),
        header: header("floor"),
        rows,
    }
}

pub(super) fn by_overlap(judged: &[Judged]) -> Table {
    let rows = BANDS.map(|[low, high]| {
        let pairs = to_merge(judged, |one| {
            let overlap = one.overlap.unwrap_or(0.0);
            !one.kind.repeats() && overlap >= low && overlap < high
        });
        [vec![format!("{low:.2}–{high:.2}")], columns(&pairs)].concat()
    });
    Table {
        caption: "Pairs to merge by overlap (of the smaller map), floors that do not repeat."
            .to_owned(),
        header: header("overlap"),
        rows: rows.to_vec(),
    }
}

/// By who made either map.
pub(super) fn by_style(judged: &[Judged]) -> Table {
    let rows = MapStyle::ALL.map(|style| {
        let pairs = to_merge(judged, |one| !one.kind.repeats() && one.styles.contains(&style));
        [vec![style.name().to_owned()], columns(&pairs)].concat()
    });
    Table {
        caption: "Pairs to merge by the style of either map, floors that do not repeat.".to_owned(),
        header: header("style"),
        rows: rows.to_vec(),
    }
}

/// Edges of the bins of bend, metres.
const BENDS: [[f64; 2]; 4] = [[0.0, 0.01], [0.01, 0.08], [0.08, 0.15], [0.15, f64::INFINITY]];

/// By how far the maps are bent against each other, and whether the covariance of what was merged
/// rightly holds.
pub(super) fn by_bend(judged: &[Judged]) -> Table {
    let rows = BENDS.map(|[low, high]| {
        let pairs = to_merge(judged, |one| {
            let enough = one.overlap.is_some_and(|overlap| overlap >= 0.35);
            !one.kind.repeats() && enough && one.residual >= low && one.residual < high
        });
        let name = if high.is_finite() {
            format!("{low:.2}–{high:.2} m")
        } else {
            format!("from {low:.2} m")
        };
        let nees: Vec<f64> = pairs
            .iter()
            .filter(|one| one.is_merged() && one.is_right())
            .filter_map(|one| one.nees)
            .collect();
        let inside = nees.iter().filter(|&&nees| nees <= NEES_95).count();
        [vec![name], columns(&pairs), vec![share(inside, nees.len())]].concat()
    });
    let mut header = header("residual");
    header.push("error inside the stated 95 %".to_owned());
    Table {
        caption:
            "Pairs to merge at overlap from 0.35 by the residual of the best rigid transform, \
                  floors that do not repeat."
                .to_owned(),
        header,
        rows: rows.to_vec(),
    }
}

/// How near the poses of merges lie that count as right, where the truth is exact.
pub(super) fn accuracy(judged: &[Judged]) -> Table {
    let row = |name: &str, holds: &dyn Fn(FloorKind) -> bool| {
        let cells = cells_off(judged, |one| holds(one.kind));
        let near = cells.iter().filter(|&&cells| cells <= 1.0).count();
        let text = |cells: Option<f64>| {
            cells.map_or_else(|| "–".to_owned(), |cells| format!("{cells:.2}"))
        };
        let worst = cells.iter().copied().reduce(f64::max);
        let count = cells.len().to_string();
        vec![name.to_owned(), count, text(median(&cells)), share(near, cells.len()), text(worst)]
    };
    let kinds = FloorKind::ALL.into_iter().filter(|kind| !kind.repeats());
    let mut rows: Vec<Vec<String>> =
        kinds.map(|kind| row(kind.name(), &|other| other == kind)).collect();
    rows.push(row("all", &|_| true));
    let header = ["floor", "merged rightly", "median, cells", "within a cell", "worst, cells"];
    Table {
        caption: "Errors of the poses of what was merged rightly, where no map is bent and the \
                  truth is exact, in cells of the coarser map; floors that do not repeat."
            .to_owned(),
        header: header.map(str::to_owned).to_vec(),
        rows,
    }
}

pub(super) fn to_refuse(judged: &[Judged]) -> Table {
    let row = |name: &str, holds: &dyn Fn(&Judged) -> bool| {
        let pairs: Vec<&Judged> =
            judged.iter().filter(|one| one.overlap.is_none() && holds(one)).collect();
        let merged = share(count(&pairs, Judged::is_merged), pairs.len());
        vec![name.to_owned(), pairs.len().to_string(), merged]
    };
    let is = |relation| move |one: &Judged| one.relation == relation;
    let apart = is(Relation::Apart);
    let repeating: Vec<bool> = judged
        .iter()
        .filter(|one| apart(one))
        .filter_map(|one| one.is_merged_though_it_repeats)
        .collect();
    let told = vec![
        "the same, and the matcher is told that it repeats".to_owned(),
        repeating.len().to_string(),
        share(repeating.iter().filter(|&&merged| merged).count(), repeating.len()),
    ];
    Table {
        caption: "Pairs to refuse, and how many were merged all the same.".to_owned(),
        header: ["maps", "pairs", "merged"].map(str::to_owned).to_vec(),
        rows: vec![
            row("two floors", &is(Relation::Unrelated)),
            row("two floors of two kinds, other robots", &is(Relation::Strangers)),
            row("two parts of a floor that does not repeat", &|one| {
                apart(one) && !one.kind.repeats()
            }),
            row("all of these", &Judged::is_decidable),
            row("two parts of a floor that repeats", &|one| apart(one) && one.kind.repeats()),
            told,
        ],
    }
}
