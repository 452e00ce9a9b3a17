//! What X3 must show.

use super::record::{count, errors_deg};
use crate::judge::{DIRECTION, PoseError};
use crate::measured::Run;
use crate::report::{Criterion, number};
use crate::stats::{Share, Summary};

/// The paper's standard deviation, degrees.
const PAPER_SD: f64 = 0.5598;

/// What is asked for, degrees.
struct Floors {
    mean: f64,
    paper_sd: f64,
    sd: f64,
}

const FULL: Floors = Floors { mean: 0.1, paper_sd: PAPER_SD, sd: 0.2 };
/// Twenty extractions: the mean of the corrected weights has a standard error of about 0.04°.
const QUICK: Floors = Floors { mean: 0.2, paper_sd: PAPER_SD, sd: 0.25 };

/// Least share of extractions whose direction is right, few runs or many.
const RIGHT: f64 = 0.95;

pub(super) fn criteria(runs: &[Run], quick: bool) -> Vec<Criterion> {
    let floors = if quick { QUICK } else { FULL };
    let summary = |id: &str| Summary::of(&errors_deg(runs, id));
    let (mean_b, interval_b, sd_b) =
        summary("X3b").map_or((f64::NAN, None, f64::NAN), |s| (s.mean.abs(), Some(s.ci95), s.sd));
    let sd_d = summary("X3d").map_or(f64::NAN, |s| s.sd);
    let sd_c = summary("X3c").map_or(f64::NAN, |s| s.sd);
    let criterion =
        |id: &str, statement: String, paper: &str, ours: f64, interval, limit: f64| Criterion {
            id: id.to_owned(),
            statement,
            paper: Some(paper.to_owned()),
            ours,
            interval,
            pass: ours <= limit,
        };
    let Floors { mean, paper_sd, sd } = floors;
    let of_mean = format!("corrected weights: |mean − truth| ≤ {mean}°");
    let of_paper_sd = format!("corrected weights: σ ≤ {paper_sd}°");
    let default = format!("default: σ ≤ {sd}°");
    let turned = format!("default, turned maps: σ ≤ {sd}°");
    let mut criteria = vec![
        criterion("X3b: mean", of_mean, "0.0497", mean_b, interval_b, mean),
        criterion("X3b: σ", of_paper_sd, "0.5598", sd_b, None, paper_sd),
        criterion("X3c: σ", default, "0.5598", sd_c, None, sd),
        criterion("X3d: σ", turned, "0.5598", sd_d, None, sd),
    ];
    criteria.extend(["X3c", "X3d"].map(|id| right(runs, id)));
    criteria
}

/// The share of extractions that found a direction, and the right one.
fn right(runs: &[Run], id: &str) -> Criterion {
    let is_right = |degrees: &&f64| {
        let turn = degrees.to_radians().abs();
        DIRECTION.admits(PoseError { displacement: 0.0, turn }, 1.0)
    };
    let hits = errors_deg(runs, id).iter().filter(is_right).count();
    let share = Share { hits, of: count(runs, id) };
    Criterion {
        id: format!("{id}: right"),
        statement: format!(
            "share of extractions that find a direction within {}° ≥ {RIGHT}",
            number(DIRECTION.turn.to_degrees())
        ),
        paper: None,
        ours: share.fraction(),
        interval: Some(share.ci95()),
        pass: share.fraction() >= RIGHT,
    }
}
