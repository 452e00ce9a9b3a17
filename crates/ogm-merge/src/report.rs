//! What was found about a pair of maps.

use grid_match::{Evidence, MatchReport, PreparedMap, score_pose};
use nalgebra::Matrix3;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Progress, Se2};
use radon_merge::RadonMatch;

use crate::walk::CarpinReport;
use crate::{MergeError, Method, TagEvidence, Warning};

/// The answer about a pair of maps, and what led to it.
///
/// With the feature `serde` its serialised form is the answer of the command `ogm align --json`,
/// less what only the command knows (files, elapsed time).
#[derive(Debug, Clone)]
pub struct PairReport {
    /// The method that gave the answer; never [`Method::Auto`].
    pub method: Method,
    /// Seed of everything random.
    pub seed: u64,
    /// The transform that maps points of the source map into the target map, or why none is
    /// believed.
    pub outcome: Outcome<Se2>,
    /// The best transform found, believed or not.
    pub target_from_source: Option<Se2>,
    /// Known in both maps over known in the smaller one, under the best transform.
    pub overlap: Option<f64>,
    /// Share of the compared wall that fits, under the best transform.
    pub agreement: Option<f64>,
    /// Distinct poses, best first, at most five.
    pub hypotheses: Vec<Hypothesis>,
    /// What makes the answer less sure than it looks.
    pub warnings: Vec<Warning>,
    /// What each stage saw.
    pub stages: Stages,
}

impl PairReport {
    /// The outcome in a word.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match &self.outcome {
            Outcome::Found(_) => Verdict::Merged,
            Outcome::Refused(refusal) if refusal.is_ambiguous() => Verdict::Ambiguous,
            Outcome::Refused(_) => Verdict::NoMatch,
        }
    }

    /// Probability that the best transform is right; `None` for a method without a calibrated one.
    #[must_use]
    pub fn probability(&self) -> Option<f64> {
        self.hypotheses.first().and_then(|best| best.probability)
    }
}

/// Whether two maps match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// They do.
    Merged,
    /// Several ways to lay them on each other fit about as well.
    Ambiguous,
    /// None fits well enough.
    NoMatch,
}

impl Verdict {
    /// As reports call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Merged => "merged",
            Self::Ambiguous => "ambiguous",
            Self::NoMatch => "no-match",
        }
    }
}

/// One way to lay the source on the target.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// Maps points of the source map into the target map.
    pub target_from_source: Se2,
    /// Probability that it is right; `None` for a method without a calibrated one.
    pub probability: Option<f64>,
    /// Log-odds that it is right against that no pose is, by what the maps say about it
    /// ([`grid_match::Evidence::score`]).
    pub score: f64,
    /// Covariance of (x, y, θ) in target axes, m², m·rad, rad²; `None` for a method without one.
    pub covariance: Option<Matrix3<f64>>,
    /// How far parts of the maps lie from where this puts them, root mean square, metres; `None`
    /// for a method that does not look.
    pub bend_m: Option<f64>,
}

impl From<&grid_match::Hypothesis> for Hypothesis {
    fn from(found: &grid_match::Hypothesis) -> Self {
        Self {
            target_from_source: found.pose.target_from_source,
            probability: Some(found.pose.probability),
            score: found.score,
            covariance: Some(found.pose.covariance),
            bend_m: Some(found.bend.rms_m),
        }
    }
}

impl Hypothesis {
    /// A pose of a method that says nothing about it, and what `maps`, target first, say.
    pub(crate) fn scored(
        maps: [&OccupancyGrid; 2],
        target_from_source: Se2,
        thresholds: &ClassThresholds,
        progress: &dyn Progress,
    ) -> Result<(Self, Evidence), MergeError> {
        let [target, source] = maps;
        let target = PreparedMap::new(target, thresholds, progress)?;
        let source = PreparedMap::new(source, thresholds, progress)?;
        let evidence = score_pose(&target, &source, &target_from_source)?;
        let score = evidence.score();
        Ok((
            Self { target_from_source, probability: None, score, covariance: None, bend_m: None },
            evidence,
        ))
    }
}

/// What each stage saw; what did not run is `None` or empty.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Stages {
    /// Of a method by tags.
    pub tags: Option<TagEvidence>,
    /// The random walks, in order.
    pub walks: Vec<CarpinReport>,
    /// Of segments and the Radon transform.
    pub radon: Option<RadonMatch>,
    /// Of the maps alone.
    pub matching: Option<MatchReport>,
}
