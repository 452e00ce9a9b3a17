//! What a method says about a pair of maps.

use grid_match::{Evidence, PreparedMap, score_pose};
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Se2};

use crate::answer::Hypothesis;
use crate::pose::Pose;

/// The answer of a method and what the maps say about it.
pub(crate) struct Found {
    pub(crate) method: &'static str,
    pub(crate) outcome: Outcome<Se2>,
    /// Accepted or not.
    pub(crate) target_from_source: Option<Se2>,
    pub(crate) overlap: Option<f64>,
    pub(crate) agreement: Option<f64>,
    pub(crate) hypotheses: Vec<Hypothesis>,
}

impl Found {
    /// The answer of a method that knows one transform at most, accepted or not, and no
    /// probability: what `maps`, target first, say about that transform.
    pub(crate) fn scored(
        method: &'static str,
        outcome: Outcome<Se2>,
        target_from_source: Option<Se2>,
        maps: [&OccupancyGrid; 2],
    ) -> anyhow::Result<Self> {
        let evidence = target_from_source.map(|pose| evidence(maps, &pose)).transpose()?;
        let hypotheses = target_from_source.zip(evidence).map(|(target_from_source, evidence)| {
            let pose = Pose::from(target_from_source);
            Hypothesis { pose, probability: None, score: evidence.score(), covariance: None }
        });
        Ok(Self {
            method,
            outcome,
            target_from_source,
            overlap: evidence.map(|evidence| evidence.overlap),
            agreement: evidence.map(|evidence| evidence.agreement()),
            hypotheses: hypotheses.into_iter().collect(),
        })
    }
}

fn evidence(maps: [&OccupancyGrid; 2], target_from_source: &Se2) -> anyhow::Result<Evidence> {
    let thresholds = ClassThresholds::default();
    let [target, source] = maps.map(|map| PreparedMap::new(map, &thresholds, &()));
    Ok(score_pose(&target?, &source?, target_from_source)?)
}
