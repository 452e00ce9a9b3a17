//! What X4 must show.

use super::record::{Cell, MATCH, REGIMES, case_name, case_without_tags};
use crate::cases::worlds::Building;
use crate::judge::{METHOD_3, SAME_WALLS};
use crate::measured::Run;
use crate::report::Criterion;
use crate::stats::Share;

/// The paper's mean over five experiments of method #2, px².
const METHOD_2: f64 = 123.45;

/// Shares that are asked for.
struct Floors {
    /// Of the unrefused runs, within the paper's mean.
    within: f64,
    /// At most, of the unrefused runs, beyond 100 px².
    beyond: f64,
    /// Of all runs, found within the paper's mean.
    found: f64,
}

const FULL: Floors = Floors { within: 0.95, beyond: 0.02, found: 0.65 };
/// Twelve worlds, of which two have too few tags for a method that needs three.
const QUICK: Floors = Floors { within: 0.9, beyond: 0.1, found: 0.6 };

/// The criteria of X4, on random plans.
pub(super) fn criteria(runs: &[Run], quick: bool) -> Vec<Criterion> {
    let floors = if quick { QUICK } else { FULL };
    let mut criteria: Vec<Criterion> =
        REGIMES.iter().flat_map(|&sigma_px| of_regime(runs, sigma_px, &floors)).collect();
    let without_tags = case_without_tags(Building::Random);
    criteria.extend(refined(runs, "X4", [&without_tags, MATCH], &floors));

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

fn of_regime(runs: &[Run], sigma_px: f64, floors: &Floors) -> Vec<Criterion> {
    let case = case_name(Building::Random, sigma_px);
    let name = format!("X4 + {sigma_px:.0} px");
    let mut criteria = refined(runs, &name, [&case, "#3"], floors);
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
fn refined(runs: &[Run], name: &str, [case, method]: [&str; 2], floors: &Floors) -> Vec<Criterion> {
    let paper = (method == "#3").then_some("2.6");
    let cell = Cell::new(runs, case, method);
    let summary = cell.summary();
    let median = summary.as_ref().map_or(f64::NAN, |summary| summary.median);
    let errors = cell.mse_disp();
    let within = Share::holding(&errors, |&mse| METHOD_3.admits_walls(mse));
    let beyond = Share::holding(&errors, |&mse| SAME_WALLS.excludes_walls(mse));
    let found = Share { of: cell.len(), ..within };
    let percent = |share: f64| (100.0 * share).round();
    vec![
        Criterion {
            id: format!("{name}: {method} median"),
            statement: format!(
                "{case}: median mse_disp of {method} ≤ 2.6 px²; shown with its quartiles"
            ),
            paper: paper.map(str::to_owned),
            ours: median,
            interval: summary.map(|summary| (summary.q25, summary.q75)),
            pass: METHOD_3.admits_walls(median),
        },
        Criterion {
            id: format!("{name}: {method} within 2.6"),
            statement: format!(
                "{case}: ≥ {} % of the unrefused runs of {method} ≤ 2.6 px²",
                percent(floors.within)
            ),
            paper: None,
            ours: within.fraction(),
            interval: Some(within.ci95()),
            pass: within.fraction() >= floors.within,
        },
        Criterion {
            id: format!("{name}: {method} beyond 100"),
            statement: format!(
                "{case}: at most {} % of the runs of {method} beyond 100 px²",
                percent(floors.beyond)
            ),
            paper: None,
            ours: beyond.fraction(),
            interval: Some(beyond.ci95()),
            pass: beyond.fraction() <= floors.beyond,
        },
        Criterion {
            id: format!("{name}: {method} found"),
            statement: format!(
                "{case}: ≥ {} % of all runs of {method} merged within 2.6 px²",
                percent(floors.found)
            ),
            paper: None,
            ours: found.fraction(),
            interval: Some(found.ci95()),
            pass: found.fraction() >= floors.found,
        },
    ]
}

fn mean(cell: &Cell<'_>) -> f64 {
    cell.summary().map_or(f64::NAN, |summary| summary.mean)
}
