//! The tables of X5.

use super::record::{CORRECTED, Walked, shown};
use super::variants::Variant;
use crate::cases::rescue::CASES;
use crate::report::Table;
use crate::stats::{Share, mean};

/// What a cell shows of its walks.
type Shown<'a> = dyn Fn(&[&Walked]) -> String + 'a;

/// Success by variant and case, and what else the walks did.
pub(super) fn draw(variants: &[Variant], walked: &[Walked]) -> Vec<Table> {
    let header = |last: Option<&str>| {
        let names = CASES.iter().map(|case| case.name).chain(last);
        std::iter::once("variant").chain(names).map(str::to_owned).collect::<Vec<_>>()
    };
    let of = |variant: &Variant, case: Option<&str>| -> Vec<&Walked> {
        let fits = |walk: &&Walked| {
            walk.variant == variant.name && case.is_none_or(|case| walk.case == case)
        };
        walked.iter().filter(fits).collect()
    };
    let rows = |cell: &Shown<'_>, last: Option<&Shown<'_>>| {
        let row = |variant: &Variant| {
            let cells = CASES.iter().map(|case| cell(&of(variant, Some(case.name))));
            let last = last.map(|last| last(&of(variant, None)));
            std::iter::once(variant.name.to_owned()).chain(cells).chain(last).collect()
        };
        variants.iter().map(row).collect::<Vec<Vec<String>>>()
    };
    let evaluations = |walks: &[&Walked]| {
        let counts: Vec<f64> = walks.iter().map(|walk| walk.evaluations as f64).collect();
        mean(&counts).map_or("–".to_owned(), |mean| format!("{mean:.0}"))
    };
    vec![
        Table {
            caption: format!(
                "Share of walks of 200 samples that end within 2 cells and 3° of the truth, with \
                 Wilson's 95 % interval; {}. Last, the mean share of the known cells that both \
                 maps know.",
                walks_a_cell(walked)
            ),
            header: header(Some("ψ evaluations")),
            rows: {
                let success = |walks: &[&Walked]| share(walks, |walk| walk.success);
                let mut rows = rows(&success, Some(&evaluations));
                rows.push(shared(walked));
                rows
            },
        },
        Table {
            caption: "Share of walks that end where ψ is below ψ of the truth.".to_owned(),
            header: header(None),
            rows: rows(&|walks| share(walks, |walk| walk.below_truth), None),
        },
    ]
}

/// How many walks are behind a cell: with few of them, more of those that are judged.
fn walks_a_cell(walked: &[Walked]) -> String {
    let count = |case: &str| {
        walked.iter().filter(|walk| walk.case == case && walk.variant == CORRECTED).count()
    };
    let [full, .., drives] = CASES.map(|case| count(case.name));
    if full == drives {
        format!("{full} walks a cell")
    } else {
        format!("{drives} walks a cell, {full} of the corrected walk on the whole building")
    }
}

/// How much the maps of each case have in common.
fn shared(walked: &[Walked]) -> Vec<String> {
    let of_case = |name: &str| {
        let walks = walked.iter().filter(|walk| walk.case == name);
        mean(&walks.map(|walk| walk.shared).collect::<Vec<_>>())
    };
    let cells = CASES.iter().map(|case| of_case(case.name));
    let cells = cells.map(|mean| mean.map_or("–".to_owned(), |mean| format!("{mean:.2}")));
    let name = std::iter::once("shared cells".to_owned());
    name.chain(cells).chain(std::iter::once(String::new())).collect()
}

/// "0.98 [0.90, 1.00]".
fn share(walks: &[&Walked], holds: impl Fn(&Walked) -> bool) -> String {
    shown(Share::holding(walks, |walk| holds(walk)))
}
