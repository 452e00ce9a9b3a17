//! What X9 must show.

use super::record::{Judged, Pair, pairs};
use super::tables::{medians, placed_by_both, within};
use crate::report::Criterion;
use crate::stats::wilson_ci95;

/// Percents.
struct Floors {
    right: f64,
    wrong: f64,
    repeating: f64,
    /// Inside the stated 95 %.
    inside: [f64; 2],
    /// Median error of the team over that of the pairs.
    error: f64,
}

const FULL: Floors =
    Floors { right: 98.0, wrong: 0.2, repeating: 95.0, inside: [90.0, 99.0], error: 1.0 };
/// A handful of teams.
const QUICK: Floors =
    Floors { right: 60.0, wrong: 2.0, repeating: 30.0, inside: [50.0, 100.0], error: 1.5 };

pub(super) fn criteria(judged: &[Judged], quick: bool) -> Vec<Criterion> {
    let floors = if quick { QUICK } else { FULL };
    let plain = pairs(judged, |kind| !kind.repeats());
    let enough: Vec<&Pair> = plain.iter().copied().filter(|pair| pair.shares_enough).collect();
    let repeating = pairs(judged, ogm_sim::FloorKind::repeats);
    let joined: Vec<&Pair> = repeating.into_iter().filter(|pair| pair.joint.is_placed()).collect();
    let strangers: Vec<bool> = judged.iter().filter_map(|team| team.stranger).collect();
    let joined_strangers = strangers.iter().filter(|&&joined| joined).count();
    let percent =
        |id: &str, statement: String, hits: usize, of: usize, pass: &dyn Fn(f64) -> bool| {
            let (low, high) = wilson_ci95(hits, of);
            let ours = 100.0 * hits as f64 / of.max(1) as f64;
            Criterion {
                id: format!("X9 {id}"),
                statement,
                paper: None,
                ours,
                interval: Some((100.0 * low, 100.0 * high)),
                pass: of > 0 && pass(ours),
            }
        };
    let hits =
        |pairs: &[&Pair], holds: fn(&Pair) -> bool| pairs.iter().filter(|pair| holds(pair)).count();
    let both = placed_by_both(judged);
    let error = |answer: fn(&Pair) -> &super::record::Answer| {
        medians(both.iter().map(|pair| answer(pair))).map_or(f64::NAN, |(metres, _)| metres)
    };
    let ratio = error(|pair| &pair.joint) / error(|pair| &pair.alone);
    let (inside, of) = within(judged);
    let Floors { right, wrong, repeating, inside: [low, high], error } = floors;
    vec![
        percent(
            "right",
            format!("pairs that share ≥ 5 m of wall, placed rightly ≥ {right} %"),
            hits(&enough, |pair| pair.joint.is_right()),
            enough.len(),
            &|ours| ours >= right,
        ),
        percent(
            "wrong",
            format!("pairs placed wrongly ≤ {wrong} %"),
            hits(&plain, |pair| pair.joint.is_wrong()),
            plain.len(),
            &|ours| ours <= wrong,
        ),
        percent(
            "repeating",
            format!("floors that repeat: of the pairs placed, right ≥ {repeating} %"),
            hits(&joined, |pair| pair.joint.is_right()),
            joined.len(),
            &|ours| ours >= repeating,
        ),
        percent(
            "stranger",
            "strangers joined: none".to_owned(),
            joined_strangers,
            strangers.len(),
            &|ours| ours == 0.0,
        ),
        percent(
            "inside",
            format!("errors inside the stated 95 %: {low}–{high} %"),
            inside,
            of,
            &|ours| (low..=high).contains(&ours),
        ),
        Criterion {
            id: "X9 error".to_owned(),
            statement: format!("median error of the team ≤ {error} × that of the pairs alone"),
            paper: None,
            ours: ratio,
            interval: None,
            pass: ratio <= error,
        },
    ]
}
