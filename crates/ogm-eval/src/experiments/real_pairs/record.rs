//! What the methods answered on a real pair, and how each answer is judged.

use ogm_core::Se2;
use ogm_merge::TagEvidence;

use crate::cases::map_pair::MapPair;
use crate::judge::Verdict;
use crate::measured::{Run, RunResult};

/// The method that gets the two maps and nothing else.
pub(super) const MATCH: &str = "match";

/// The columns of the table and the order of the runs.
pub(super) const NAMES: [&str; 4] = ["#1", "#2", "#3", MATCH];

/// What the methods answered on one pair.
#[derive(Default)]
pub(super) struct Answers {
    pub(super) runs: Vec<Run>,
    /// What #3 saw.
    pub(super) evidence: TagEvidence,
    /// What #3 answered.
    pub(super) target_from_source: Option<Se2>,
}

/// A pair with its answers.
pub(super) struct Answered {
    pub(super) pair: MapPair,
    pub(super) answers: Answers,
}

impl Answered {
    /// What a method answered.
    pub(super) fn result(&self, method: &str) -> Option<&RunResult> {
        let run = self.answers.runs.iter().find(|run| run.variant == method);
        run.map(|run| &run.result)
    }

    /// How good the answer of a method is.
    pub(super) fn verdict(&self, method: &str) -> Verdict {
        match (self.result(method), &self.pair.truth) {
            (Some(RunResult::Transform(error)), Some(truth)) => {
                Verdict::of_error(error.pose, truth)
            }
            (_, Some(_)) => Verdict::Missed,
            (Some(RunResult::Refused(_)), None) => Verdict::Refused,
            (_, None) => Verdict::False,
        }
    }
}
