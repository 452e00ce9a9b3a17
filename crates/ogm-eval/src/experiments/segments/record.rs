//! What is kept of a search from scratch.

use radon_merge::RadonMatch;

use crate::measured::{Measured, Run, RunResult, Timing};
use crate::report::Section;

/// One search.
pub(super) struct Searched {
    pub(super) name: String,
    pub(super) found: RadonMatch,
    pub(super) milliseconds: f64,
    /// Of the answer or, where there is none, of nothing.
    pub(super) result: RunResult,
    /// Which candidate is right, the first.
    pub(super) right: Option<usize>,
    /// Whether the answer is right.
    pub(super) is_right: bool,
}

impl Searched {
    pub(super) fn is_wrong(&self) -> bool {
        !self.is_right && self.found.accepted.is_some()
    }
}

pub(super) fn measured(
    id: &'static str,
    section: Section,
    searched: Vec<Searched>,
    seed: u64,
) -> Measured {
    let timings = searched.iter().map(|one| Timing {
        experiment: id,
        step: "find_transform",
        seed,
        milliseconds: one.milliseconds,
    });
    let timings = timings.collect();
    let runs = searched.into_iter().map(|one| Run {
        experiment: id,
        case: one.name,
        variant: "radon".to_owned(),
        seed,
        result: one.result,
    });
    Measured { sections: vec![section], runs: runs.collect(), timings }
}
