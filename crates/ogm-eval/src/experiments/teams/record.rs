//! What is kept of a team, and how its pairs are counted.

use ogm_core::Refusal;
use ogm_sim::FloorKind;

use crate::judge::{PoseError, TransformError};
use crate::measured::{Run, RunResult};

/// One team and what was said about it.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    pub(super) kind: FloorKind,
    pub(super) seed: u64,
    pub(super) pairs: Vec<Pair>,
    /// Whether there is a map of another building, and whether it was joined to any.
    pub(super) stranger: Option<bool>,
}

/// Two maps of one building.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    /// Whether enough wall is in both.
    pub(super) shares_enough: bool,
    /// By the two maps themselves.
    pub(super) alone: Answer,
    /// By the team.
    pub(super) joint: Answer,
    /// What the team says of how sure it is.
    pub(super) probability: Option<f64>,
    /// Squared error of the joint pose in units of its covariance, where the target is the
    /// reference and both maps share enough.
    pub(super) nees: Option<f64>,
}

/// What came of a pair.
#[derive(Debug, Clone)]
pub(super) enum Answer {
    Apart(Option<Refusal>),
    Placed { error: PoseError, is_right: bool },
}

impl Answer {
    pub(super) fn is_placed(&self) -> bool {
        matches!(self, Self::Placed { .. })
    }

    pub(super) fn is_right(&self) -> bool {
        matches!(self, Self::Placed { is_right: true, .. })
    }

    pub(super) fn is_wrong(&self) -> bool {
        matches!(self, Self::Placed { is_right: false, .. })
    }

    pub(super) fn right_error(&self) -> Option<PoseError> {
        match self {
            Self::Placed { error, is_right: true } => Some(*error),
            _ => None,
        }
    }
}

/// The pairs of the teams of some kinds.
pub(super) fn pairs(judged: &[Judged], holds: impl Fn(FloorKind) -> bool) -> Vec<&Pair> {
    judged.iter().filter(|team| holds(team.kind)).flat_map(|team| &team.pairs).collect()
}

/// The rows of a team: its pairs that share enough, alone and together.
pub(super) fn rows(team: &Judged) -> Vec<Run> {
    let run = |variant: &str, answer: &Answer| Run {
        experiment: "X9",
        case: team.kind.name().to_owned(),
        variant: variant.to_owned(),
        seed: team.seed,
        result: match answer {
            Answer::Placed { error, .. } => RunResult::Transform(TransformError::over_area(*error)),
            Answer::Apart(refusal) => RunResult::Refused(
                refusal.clone().unwrap_or(Refusal::Unlikely { probability: 0.0, need: 0.9 }),
            ),
        },
    };
    let enough = team.pairs.iter().filter(|pair| pair.shares_enough);
    enough.flat_map(|pair| [run("alone", &pair.alone), run("team", &pair.joint)]).collect()
}
