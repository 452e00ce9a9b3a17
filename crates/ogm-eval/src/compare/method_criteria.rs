//! What X4 must show.

use super::method_tables::{Cell, METHOD_3, OUTLIER};
use super::methods::{MATCH, REGIMES, case_name, case_without_tags};
use super::record::Run;
use super::worlds::Building;
use crate::report::Criterion;
use crate::stats::wilson_ci95;

/// The paper's mean over five experiments of method #2, px².
const METHOD_2: f64 = 123.45;

/// The criteria of X4, on random plans.
pub(super) fn criteria(runs: &[Run]) -> Vec<Criterion> {
    let mut criteria: Vec<Criterion> =
        REGIMES.iter().flat_map(|&sigma_px| of_regime(runs, sigma_px)).collect();
    let without_tags = case_without_tags(Building::Random);
    criteria.extend(refined(runs, "X4", &without_tags, MATCH));

    let case = case_name(Building::Random, 10.0);
    let means = ["#1", "#2", "#3"].map(|variant| mean(&Cell::new(runs, &case, variant)));
    criteria.push(Criterion {
        id: "X4 + 10 px: ordering".to_owned(),
        statement: format!("{case}: mean mse_disp of #1 > #2 > #3; shown: #1 / #2"),
        paper: Some("58".to_owned()),
        ours: means[0] / means[1],
        interval: None,
        pass: means[0] > means[1] && means[1] > means[2],
    });
    let case = case_name(Building::Random, 0.0);
    let printed = Cell::new(runs, &case, "#1 all as printed");
    criteria.push(Criterion {
        id: "X4: #1 as printed".to_owned(),
        statement: format!("{case}: mean mse_disp of #1 with every formula as printed ≥ 1000 px²"),
        paper: Some("7178.27".to_owned()),
        ours: mean(&printed),
        interval: printed.summary().map(|summary| summary.ci95),
        pass: mean(&printed) >= 1000.0,
    });
    criteria
}

fn of_regime(runs: &[Run], sigma_px: f64) -> Vec<Criterion> {
    let case = case_name(Building::Random, sigma_px);
    let name = format!("X4 + {sigma_px:.0} px");
    let mut criteria = refined(runs, &name, &case, "#3");
    if sigma_px <= 5.0 {
        let method_2 = Cell::new(runs, &case, "#2");
        criteria.push(Criterion {
            id: format!("{name}: #2 mean"),
            statement: format!("{case}: mean mse_disp of #2 ≤ 123.45 px²"),
            paper: Some("123.45".to_owned()),
            ours: mean(&method_2),
            interval: method_2.summary().map(|summary| summary.ci95),
            pass: mean(&method_2) <= METHOD_2,
        });
    }
    criteria
}

/// What a method must show that refines its answer on the walls.
fn refined(runs: &[Run], name: &str, case: &str, method: &str) -> Vec<Criterion> {
    let paper = (method == "#3").then_some("2.6");
    let cell = Cell::new(runs, case, method);
    let summary = cell.summary();
    let median = summary.as_ref().map_or(f64::NAN, |summary| summary.median);
    let within = Share::of(&cell.mse_disp(), |mse| mse <= METHOD_3);
    let beyond = Share::of(&cell.mse_disp(), |mse| mse > OUTLIER);
    vec![
        Criterion {
            id: format!("{name}: {method} median"),
            statement: format!(
                "{case}: median mse_disp of {method} ≤ 2.6 px²; shown with its quartiles"
            ),
            paper: paper.map(str::to_owned),
            ours: median,
            interval: summary.map(|summary| (summary.q25, summary.q75)),
            pass: median <= METHOD_3,
        },
        Criterion {
            id: format!("{name}: {method} within 2.6"),
            statement: format!("{case}: ≥ 95 % of the unrefused runs of {method} ≤ 2.6 px²"),
            paper: None,
            ours: within.share,
            interval: Some(within.interval),
            pass: within.share >= 0.95,
        },
        Criterion {
            id: format!("{name}: {method} beyond 100"),
            statement: format!("{case}: at most 2 % of the runs of {method} beyond 100 px²"),
            paper: None,
            ours: beyond.share,
            interval: Some(beyond.interval),
            pass: beyond.share <= 0.02,
        },
    ]
}

fn mean(cell: &Cell<'_>) -> f64 {
    cell.summary().map_or(f64::NAN, |summary| summary.mean)
}

/// A share of runs with its Wilson 95 % interval.
struct Share {
    share: f64,
    interval: (f64, f64),
}

impl Share {
    fn of(values: &[f64], counts: impl Fn(f64) -> bool) -> Self {
        let count = values.iter().filter(|&&value| counts(value)).count();
        let share = count as f64 / values.len() as f64;
        Self { share, interval: wilson_ci95(count, values.len()) }
    }
}
