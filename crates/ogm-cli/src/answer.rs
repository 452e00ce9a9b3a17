//! What was found about a pair of maps, as its JSON says it.

use ogm_core::{Refusal, Se2};
use serde::{Serialize, Serializer};

use crate::Ending;
use crate::input::MapFile;
use crate::pose::Pose;

/// Version of every JSON object that `ogm` writes.
pub(crate) const SCHEMA: u32 = 1;

/// Whether two maps match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Verdict {
    /// They do, under `target_from_source`.
    Merged,
    /// Several ways to lay them on each other fit about as well.
    Ambiguous,
    /// None fits well enough.
    NoMatch,
}

impl Verdict {
    pub(crate) fn of(refusal: Option<&Refusal>) -> Self {
        match refusal {
            None => Self::Merged,
            Some(refusal) if refusal.is_ambiguous() => Self::Ambiguous,
            Some(_) => Self::NoMatch,
        }
    }

    pub(crate) fn ending(self) -> Ending {
        match self {
            Self::Merged => Ending::Done,
            Self::Ambiguous | Self::NoMatch => Ending::Refused,
        }
    }
}

/// The answer on one pair of maps.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct PairAnswer {
    pub(crate) schema: u32,
    pub(crate) verdict: Verdict,
    /// Why not, unless merged.
    pub(crate) reason: Option<String>,
    pub(crate) target: MapFile,
    pub(crate) source: MapFile,
    /// The best transform found, accepted or not.
    #[serde(serialize_with = "as_pose")]
    pub(crate) target_from_source: Option<Se2>,
    /// Of the best transform; `None` for a method that has no calibrated one.
    pub(crate) probability: Option<f64>,
    pub(crate) overlap: Option<f64>,
    pub(crate) agreement: Option<f64>,
    /// At most five, best first.
    pub(crate) hypotheses: Vec<Hypothesis>,
    pub(crate) method: &'static str,
    pub(crate) seed: u64,
    pub(crate) elapsed_ms: u64,
    /// Whether both files hold the same cells in the same place.
    #[serde(skip)]
    pub(crate) copies: bool,
}

/// One way to lay the source on the target.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Hypothesis {
    #[serde(flatten)]
    pub(crate) pose: Pose,
    pub(crate) probability: Option<f64>,
    pub(crate) score: f64,
    /// Over (`x_m`, `y_m`, θ in radians) of `target_from_source` in target axes.
    pub(crate) covariance: Option<[[f64; 3]; 3]>,
}

fn as_pose<S: Serializer>(
    target_from_source: &Option<Se2>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    target_from_source.map(Pose::from).serialize(serializer)
}
