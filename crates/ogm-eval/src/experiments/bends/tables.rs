//! The numbers of X10.

use ogm_sim::MapStyle;

use super::record::{Bent, Judged, Real, merged};
use super::run::BENDS;
use crate::report::Table;
use crate::stats::median;

const HEADER: [&str; 12] = [
    "",
    "pairs",
    "merged rightly",
    "made straight",
    "residual before, m",
    "after, m",
    "known, m",
    "fall where made straight, %",
    "known there, %",
    "worst growth, cells",
    "doubled before, %",
    "after, %",
];

pub(super) fn by_bend(judged: &[Judged]) -> Table {
    let rows = BENDS.map(|bend| row(&format!("{bend} m"), judged, |one| one.bend == bend));
    table(
        "By bend, standard deviation an axis. Medians over the pairs merged rightly.",
        rows.into(),
    )
}

pub(super) fn by_overlap(judged: &[Judged]) -> Table {
    let rows = [(0.0, 0.5), (0.5, 0.8), (0.8, 2.0)].map(|(low, high)| {
        let name = format!("{low}–{}", f64::min(high, 1.0));
        row(&name, judged, |one| one.bend > 0.0 && (low..high).contains(&one.overlap))
    });
    table("By overlap, bent pairs.", rows.into())
}

pub(super) fn by_style(judged: &[Judged]) -> Table {
    let rows = MapStyle::ALL
        .map(|style| row(style.name(), judged, |one| one.bend > 0.0 && one.of_style(style)));
    table("By the style of either map, bent pairs.", rows.into())
}

fn table(caption: &str, rows: Vec<Vec<String>>) -> Table {
    Table { caption: caption.to_owned(), header: HEADER.map(str::to_owned).to_vec(), rows }
}

fn row(name: &str, judged: &[Judged], holds: impl Fn(&Judged) -> bool) -> Vec<String> {
    let all = judged.iter().filter(|one| holds(one)).count();
    let merged = merged(judged, holds);
    let applied = merged.iter().filter(|(_, bent)| bent.is_applied).count();
    let middle = |value: fn(&Bent) -> f64, digits: usize| {
        let values: Vec<f64> = merged.iter().map(|(_, bent)| value(bent)).collect();
        median(&values).map_or_else(|| "–".to_owned(), |middle| format!("{middle:.digits$}"))
    };
    let made = falls(&merged, |bent| bent.is_applied, |bent| bent.after_m);
    let known = falls(&merged, |bent| bent.is_applied, |bent| bent.known_m);
    let text = |value: Option<f64>, digits: usize| {
        value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
    };
    vec![
        name.to_owned(),
        all.to_string(),
        merged.len().to_string(),
        applied.to_string(),
        middle(|bent| bent.before_m, 3),
        middle(|bent| bent.after_m, 3),
        middle(|bent| bent.known_m, 3),
        text(median(&made), 0),
        text(median(&known), 0),
        text(worst_growth(&merged), 2),
        middle(|bent| 100.0 * bent.doubled_before, 1),
        middle(|bent| 100.0 * bent.doubled_after, 1),
    ]
}

/// By how much residuals fell to what `left` says, percent.
pub(super) fn falls(
    merged: &[(&Judged, Bent)],
    holds: impl Fn(&Bent) -> bool,
    left: impl Fn(&Bent) -> f64,
) -> Vec<f64> {
    let holding = merged.iter().filter(|(_, bent)| holds(bent));
    holding.map(|(_, bent)| 100.0 * (1.0 - left(bent) / bent.before_m.max(1e-9))).collect()
}

/// The most by which a residual grew, cells.
pub(super) fn worst_growth(merged: &[(&Judged, Bent)]) -> Option<f64> {
    let grown = merged.iter().map(|(one, bent)| (bent.after_m - bent.before_m) / one.cell);
    grown.reduce(f64::max)
}

pub(super) fn real(real: &[Real]) -> Table {
    let row = |one: &Real| {
        vec![
            one.name.clone(),
            if one.is_applied { "yes" } else { "no" }.to_owned(),
            format!("{:.1}", one.score),
            format!("{:.2} / {:.2}", one.moved_m, one.max_m),
            one.doubled_before.to_string(),
            one.doubled_after.to_string(),
            format!("{:.2}", 100.0 * one.lost_before),
            format!("{:.2}", 100.0 * one.lost_after),
        ]
    };
    let header = [
        "pair",
        "made straight",
        "score",
        "bend rms / most, m",
        "doubled cells before",
        "after",
        "lost before, %",
        "after, %",
    ];
    Table {
        caption: "Pairs that the matcher merges rightly.".to_owned(),
        header: header.map(str::to_owned).to_vec(),
        rows: real.iter().map(row).collect(),
    }
}
