//! The answer about a pair of maps.

use nalgebra::Matrix3;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::rows;
use super::stages::StagesJson;
use crate::{Hypothesis, PairReport, PoseDegrees, Verdict};

#[derive(Serialize)]
struct PairJson<'a> {
    verdict: Verdict,
    /// Why not, unless merged.
    reason: Option<String>,
    /// The best transform found, accepted or not.
    target_from_source: Option<PoseDegrees>,
    probability: Option<f64>,
    overlap: Option<f64>,
    agreement: Option<f64>,
    hypotheses: &'a [Hypothesis],
    method: &'static str,
    seed: u64,
    warnings: Vec<String>,
    stages: StagesJson,
}

impl Serialize for PairReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pair = PairJson {
            verdict: self.verdict(),
            reason: self.outcome.refusal().map(ToString::to_string),
            target_from_source: self.target_from_source.map(PoseDegrees::from),
            probability: self.probability(),
            overlap: self.overlap,
            agreement: self.agreement,
            hypotheses: &self.hypotheses,
            method: self.method.name(),
            seed: self.seed,
            warnings: self.warnings.iter().map(ToString::to_string).collect(),
            stages: StagesJson::from(&self.stages),
        };
        pair.serialize(serializer)
    }
}

impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[derive(Serialize, Deserialize)]
struct HypothesisJson {
    #[serde(flatten)]
    pose: PoseDegrees,
    probability: Option<f64>,
    score: f64,
    covariance: Option<[[f64; 3]; 3]>,
    bend_rms_m: Option<f64>,
}

impl Serialize for Hypothesis {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let hypothesis = HypothesisJson {
            pose: self.target_from_source.into(),
            probability: self.probability,
            score: self.score,
            covariance: self.covariance.as_ref().map(rows),
            bend_rms_m: self.bend_m,
        };
        hypothesis.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Hypothesis {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = HypothesisJson::deserialize(deserializer)?;
        let matrix = |rows: [[f64; 3]; 3]| Matrix3::from_fn(|row, column| rows[row][column]);
        Ok(Self {
            target_from_source: found.pose.into(),
            probability: found.probability,
            score: found.score,
            covariance: found.covariance.map(matrix),
            bend_m: found.bend_rms_m,
        })
    }
}
