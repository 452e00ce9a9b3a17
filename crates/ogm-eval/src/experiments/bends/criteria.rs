//! What X10 must show.

use super::record::{Judged, Real, merged};
use super::tables::{falls, worst_growth};
use crate::report::Criterion;
use crate::stats::median;

/// Least fall of the residual and of doubled walls, percent; most growth and most motion of pairs
/// that are not bent, cells.
const FALL: f64 = 60.0;
const GROWTH: f64 = 0.2;
const STILL: f64 = 0.1;
/// Least fall where a map was made straight, of a few runs, percent: half of what is reached fails.
const QUICK_FALL: f64 = 30.0;
/// Most wall of an input that a fused map may lack, percent: the bar of the fusion.
const LOST: f64 = 5.0;

fn criterion(id: &str, statement: String, ours: f64, pass: bool) -> Criterion {
    Criterion { id: format!("X10 {id}"), statement, paper: None, ours, interval: None, pass }
}

/// Of a few runs most pairs are not made straight, and what all of them gain is not judged.
pub(super) fn criteria(judged: &[Judged], quick: bool) -> Vec<Criterion> {
    let bent = merged(judged, |one| one.bend > 0.0);
    let still = merged(judged, |one| one.bend == 0.0);
    let all = median(&falls(&bent, |_| true, |bent| bent.after_m)).unwrap_or(f64::NAN);
    let applied =
        median(&falls(&bent, |bent| bent.is_applied, |bent| bent.after_m)).unwrap_or(f64::NAN);
    let growth = worst_growth(&bent).unwrap_or(f64::NAN);
    let moved = still.iter().map(|(one, bent)| bent.moved_m / one.cell).reduce(f64::max);
    let moved = moved.unwrap_or(f64::NAN);
    let fall = criterion(
        "fall",
        format!("residual of bent pairs falls, median ≥ {FALL} %"),
        all,
        all >= FALL,
    );
    let least = if quick { QUICK_FALL } else { FALL };
    let others = [
        criterion(
            "fall applied",
            format!("residual of pairs made straight falls, median ≥ {least} %"),
            applied,
            applied >= least,
        ),
        criterion(
            "growth",
            format!("residual of no bent pair grows by more than {GROWTH} cell"),
            growth,
            growth <= GROWTH,
        ),
        criterion(
            "still",
            format!("no pair that is not bent moves by more than {STILL} cell"),
            moved,
            moved <= STILL,
        ),
    ];
    (!quick).then_some(fall).into_iter().chain(others).collect()
}

pub(super) fn of_pairs(real: &[Real]) -> Vec<Criterion> {
    let fall =
        |one: &Real| 100.0 * (1.0 - one.doubled_after as f64 / one.doubled_before.max(1) as f64);
    let falls: Vec<f64> = real.iter().map(fall).collect();
    let middle = median(&falls).unwrap_or(f64::NAN);
    let least = falls.iter().copied().reduce(f64::min).unwrap_or(f64::NAN);
    let lost = real.iter().map(|one| 100.0 * one.lost_after).reduce(f64::max).unwrap_or(f64::NAN);
    vec![
        criterion(
            "doubled",
            format!("doubled walls of real pairs fall, median ≥ {FALL} %"),
            middle,
            middle >= FALL,
        ),
        criterion("grown", "doubled walls grow on no real pair".to_owned(), least, least >= 0.0),
        criterion(
            "lost",
            format!("walls lost of an input of a real pair ≤ {LOST} %"),
            lost,
            lost <= LOST,
        ),
    ]
}
