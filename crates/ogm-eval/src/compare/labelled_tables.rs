//! The counts of X7 and what decides about them.

use ogm_sim::{FloorKind, Relation};

use super::labelled::Judged;
use crate::report::{Criterion, Section, Table};
use crate::stats::wilson_ci95;

const ANALYSIS: &str = "\
Pairs of maps drawn at random: floors of seven kinds, the parts that two robots explore, their \
sensors and resolutions, drift, moved furniture. A merge is right if the root mean square \
displacement over what both observed is below 0.4 m, besides the residual of the best rigid \
transform of bent maps, and the turn below 3°.

The weights behind the probability were fitted on other seeds. Two kinds of floor repeat \
themselves: equal rooms, and offices that half a turn maps onto themselves. Where the robots saw \
parts that look alike and nothing else, no matcher can tell, so these kinds are counted apart, and \
of these the pairs of parts that do not overlap are in no criterion: half of a half-turn floor \
looks like the other half.";

/// Overlap at which a merge is expected.
const ENOUGH: f64 = 0.35;
const BANDS: [[f64; 2]; 5] = [[0.15, 0.25], [0.25, 0.35], [0.35, 0.5], [0.5, 0.7], [0.7, 1.0]];

pub(super) fn section(judged: &[Judged], drawn: usize, quick: bool) -> Section {
    let criteria = if quick { Vec::new() } else { criteria(judged) };
    Section {
        id: "X7".to_owned(),
        title: "Maps without tags or start: how often right, and how sure".to_owned(),
        analysis: ANALYSIS.to_owned(),
        tables: vec![by_kind(judged, drawn), by_overlap(judged), to_refuse(judged)],
        figures: Vec::new(),
        criteria,
    }
}

/// "12 of 40, 30 % [18, 45]".
fn share(hits: usize, of: usize) -> String {
    if of == 0 {
        return "–".to_owned();
    }
    let (low, high) = wilson_ci95(hits, of);
    let percent = 100.0 * hits as f64 / of as f64;
    format!("{hits} of {of}, {percent:.1} % [{:.1}, {:.1}]", 100.0 * low, 100.0 * high)
}

fn count(judged: &[&Judged], holds: impl Fn(&Judged) -> bool) -> usize {
    judged.iter().filter(|one| holds(one)).count()
}

fn to_merge(judged: &[Judged], holds: impl Fn(&Judged) -> bool) -> Vec<&Judged> {
    judged.iter().filter(|one| one.relation == Relation::Overlapping && holds(one)).collect()
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

fn by_kind(judged: &[Judged], drawn: usize) -> Table {
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

fn by_overlap(judged: &[Judged]) -> Table {
    let rows = BANDS.map(|[low, high]| {
        let pairs = to_merge(judged, |one| {
            let overlap = one.truth.map_or(0.0, |truth| truth.overlap);
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

fn to_refuse(judged: &[Judged]) -> Table {
    let row = |name: &str, holds: &dyn Fn(&Judged) -> bool| {
        let pairs: Vec<&Judged> =
            judged.iter().filter(|one| one.truth.is_none() && holds(one)).collect();
        let merged = share(count(&pairs, Judged::is_merged), pairs.len());
        vec![name.to_owned(), pairs.len().to_string(), merged]
    };
    let apart = |one: &Judged| one.relation == Relation::Apart;
    Table {
        caption: "Pairs to refuse, and how many were merged all the same.".to_owned(),
        header: ["maps", "pairs", "merged"].map(str::to_owned).to_vec(),
        rows: vec![
            row("two floors", &|one| !apart(one)),
            row("two parts of a floor that does not repeat", &|one| {
                apart(one) && !one.kind.repeats()
            }),
            row("all of these", &Judged::is_decidable),
            row("two parts of a floor that repeats", &|one| apart(one) && one.kind.repeats()),
        ],
    }
}

fn criteria(judged: &[Judged]) -> Vec<Criterion> {
    let plain = to_merge(judged, |one| !one.kind.repeats());
    let merged = count(&plain, Judged::is_merged);
    let rightly = count(&plain, |one| one.is_merged() && one.is_right());
    let enough = to_merge(judged, |one| {
        !one.kind.repeats() && one.truth.is_some_and(|truth| truth.overlap >= ENOUGH)
    });
    let found = count(&enough, |one| one.is_merged() && one.is_right());
    let refuse: Vec<&Judged> =
        judged.iter().filter(|one| one.truth.is_none() && one.is_decidable()).collect();
    let falsely = count(&refuse, Judged::is_merged);
    let percent = |hits: usize, of: usize| 100.0 * hits as f64 / of.max(1) as f64;
    let interval = |hits: usize, of: usize| {
        let (low, high) = wilson_ci95(hits, of);
        Some((100.0 * low, 100.0 * high))
    };
    let criterion = |id: &str, statement: &str, hits, of, pass: &dyn Fn(f64) -> bool| Criterion {
        id: format!("X7 {id}"),
        statement: statement.to_owned(),
        paper: None,
        ours: percent(hits, of),
        interval: interval(hits, of),
        pass: of > 0 && pass(percent(hits, of)),
    };
    let mut criteria = vec![
        criterion("right", "of merged, right ≥ 99 %", rightly, merged, &|ours| ours >= 99.0),
        criterion(
            "found",
            "merged rightly ≥ 75 % at overlap ≥ 0.35",
            found,
            enough.len(),
            &|o| o >= 75.0,
        ),
        criterion("false", "of maps to refuse, merged ≤ 0.5 %", falsely, refuse.len(), &|ours| {
            ours <= 0.5
        }),
    ];
    criteria.extend(accuracy(&plain));
    criteria
}

/// On pairs whose truth is exact.
fn accuracy(pairs: &[&Judged]) -> [Criterion; 2] {
    let exact = || pairs.iter().filter(|one| one.exact && one.is_merged() && one.is_right());
    let cells = exact().filter_map(|one| one.best.map(|best| best.displacement / one.cell));
    let degrees = exact().filter_map(|one| one.best.map(|best| best.turn.to_degrees()));
    let criterion = |id: &str, statement: &str, errors: Vec<f64>, limit: f64| {
        let ours = median(errors);
        Criterion {
            id: format!("X7 {id}"),
            statement: statement.to_owned(),
            paper: None,
            ours,
            interval: None,
            pass: ours <= limit,
        }
    };
    [
        criterion("cells", "median error, exact truth ≤ 0.25 cell", cells.collect(), 0.25),
        criterion("degrees", "median turn, exact truth ≤ 0.05°", degrees.collect(), 0.05),
    ]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
