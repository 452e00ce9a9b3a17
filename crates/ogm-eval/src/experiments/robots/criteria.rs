//! What X8 must show.

use super::record::{Filter, Placed, Robot, Share, Team};
use crate::report::Criterion;
use crate::stats::{bootstrap_ci95_of, mean, median, wilson_ci95};

/// Of the last error with scans over that of dead reckoning.
const MAX_RATIO: f64 = 0.3;
/// Percent of the maps of the last sharing that are placed rightly.
const MIN_RIGHT: f64 = 60.0;
/// The same of a few teams.
const MIN_RIGHT_QUICK: f64 = 25.0;
/// Percent of the fused walls that are right.
const MIN_WALLS: f64 = 90.0;
/// The same of a few teams.
const MIN_WALLS_QUICK: f64 = 70.0;
const SEED: u64 = 1;
/// 97.5 % quantile of the normal distribution.
const Z_975: f64 = 1.959_964;

pub(super) fn filters(robots: &[&Robot]) -> Vec<Criterion> {
    let errors = |filter: Filter| -> Vec<f64> {
        robots.iter().map(|robot| robot.end(filter).error.displacement).collect()
    };
    let (blind, full) = (errors(Filter::DeadReckoning), errors(Filter::EkfWithScans));
    let ratio_of = |drawn: &[usize]| {
        let [full, blind] = [&full, &blind].map(|values| {
            let values: Vec<f64> = drawn.iter().map(|&index| values[index]).collect();
            median(&values).unwrap_or(f64::NAN)
        });
        full / blind
    };
    let all: Vec<usize> = (0..robots.len()).collect();
    let ratio = ratio_of(&all);
    let nees: Vec<f64> =
        robots.iter().filter_map(|robot| robot.end(Filter::EkfWithScans).nees).collect();
    let (low, high) = nees_band(nees.len());
    let ours = mean(&nees).unwrap_or(f64::NAN);
    vec![
        Criterion {
            id: "X8 error".to_owned(),
            statement: format!(
                "median last error of the EKF with scans ≤ {MAX_RATIO} × that of dead reckoning"
            ),
            paper: None,
            ours: ratio,
            interval: bootstrap_ci95_of(robots.len(), SEED, ratio_of),
            pass: ratio <= MAX_RATIO,
        },
        Criterion {
            id: "X8 NEES".to_owned(),
            statement: format!(
                "mean NEES of {} runs within its 95 % band, {low:.2}–{high:.2}",
                nees.len()
            ),
            paper: None,
            ours,
            interval: bootstrap_ci95_of(nees.len(), SEED, |drawn| {
                drawn.iter().map(|&index| nees[index]).sum::<f64>() / drawn.len() as f64
            }),
            pass: nees.len() == robots.len() && (low..=high).contains(&ours),
        },
    ]
}

/// Where the mean of `runs` NEES of three degrees of freedom lies in 95 % of all cases (χ² by
/// Wilson and Hilferty, 1931).
fn nees_band(runs: usize) -> (f64, f64) {
    let freedom = 3.0 * runs as f64;
    let part = 2.0 / (9.0 * freedom);
    let end = |z: f64| freedom * (1.0 - part + z * part.sqrt()).powi(3) / runs as f64;
    (end(-Z_975), end(Z_975))
}

pub(super) fn teams(teams: &[Team], quick: bool) -> Vec<Criterion> {
    let last: Vec<&Share> = teams.iter().filter_map(|team| team.shares.last()).collect();
    let placed: Vec<&Placed> = last.iter().flat_map(|share| &share.placed).collect();
    let every = teams.iter().flat_map(|team| &team.shares).flat_map(|share| &share.placed);
    let every: Vec<&Placed> = every.collect();
    let percent =
        |id: &str, statement: String, hits: usize, of: usize, pass: &dyn Fn(f64) -> bool| {
            let (low, high) = wilson_ci95(hits, of);
            let ours = 100.0 * hits as f64 / of.max(1) as f64;
            Criterion {
                id: format!("X8 {id}"),
                statement,
                paper: None,
                ours,
                interval: Some((100.0 * low, 100.0 * high)),
                pass: of > 0 && pass(ours),
            }
        };
    let (least, least_walls) =
        if quick { (MIN_RIGHT_QUICK, MIN_WALLS_QUICK) } else { (MIN_RIGHT, MIN_WALLS) };
    let middle = |values: &[f64]| median(values).unwrap_or(f64::NAN);
    let walls: Vec<f64> = last.iter().map(|share| share.right_percent()).collect();
    let of_drawn = |values: &[f64]| {
        bootstrap_ci95_of(values.len(), SEED, |drawn| {
            middle(&drawn.iter().map(|&place| values[place]).collect::<Vec<f64>>())
        })
    };
    vec![
        percent(
            "right",
            format!("maps of the last sharing placed rightly ≥ {least} %"),
            placed.iter().filter(|placed| placed.is_right()).count(),
            placed.len(),
            &|ours| ours >= least,
        ),
        percent(
            "wrong",
            "maps placed wrongly, at any sharing: none".to_owned(),
            every.iter().filter(|placed| placed.is_wrong()).count(),
            every.len(),
            &|ours| ours == 0.0,
        ),
        Criterion {
            id: "X8 walls".to_owned(),
            statement: format!(
                "walls of the last fused map that are right, median ≥ {least_walls} %"
            ),
            paper: None,
            ours: middle(&walls),
            interval: of_drawn(&walls),
            pass: middle(&walls) >= least_walls,
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::nees_band;

    #[test]
    fn the_band_is_that_of_chi_squared() {
        // χ² of 180 degrees of freedom: 144.741 and 219.044.
        let (low, high) = nees_band(60);
        assert!((60.0 * low - 144.741).abs() < 0.05, "{low}");
        assert!((60.0 * high - 219.044).abs() < 0.05, "{high}");
    }
}
