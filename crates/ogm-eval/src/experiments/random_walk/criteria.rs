//! What X5 must show.

use super::record::{CORRECTED, Walked};
use crate::cases::rescue::{CASES, Coverage};
use crate::report::Criterion;
use crate::stats::Share;

/// Least share of successes of the corrected walk at full overlap.
const NEEDED: f64 = 0.9;
/// The same of ten walks: one in five may fail.
const NEEDED_QUICK: f64 = 0.8;

/// The corrected walk at full overlap, from both starts.
pub(super) fn criteria(walked: &[Walked], quick: bool) -> Vec<Criterion> {
    let needed = if quick { NEEDED_QUICK } else { NEEDED };
    let full = CASES.iter().filter(|case| case.coverage == Coverage::Full);
    full.map(|case| {
        let fits = |walk: &&Walked| walk.variant == CORRECTED && walk.case == case.name;
        let walks: Vec<&Walked> = walked.iter().filter(fits).collect();
        let successes = Share::holding(&walks, |walk| walk.success);
        Criterion {
            id: format!("X5: {}", case.name),
            statement: format!("corrected walk: share of successes ≥ {needed}"),
            paper: None,
            ours: successes.fraction(),
            interval: Some(successes.ci95()),
            pass: successes.fraction() >= needed,
        }
    })
    .collect()
}
