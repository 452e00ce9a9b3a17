//! The knobs of a team.

use nalgebra::Matrix3;
use ogm_core::{ParameterError, Se2, require};

use crate::{AlignParams, Hypothesis, MergeError};

/// How a team is merged.
#[derive(Debug, Clone, Default)]
pub struct TeamParams {
    /// How pairs are searched, and the probability that a join must reach
    /// ([`MatchParams::accept`](crate::MatchParams::accept)). A `prior` in it is not used.
    pub align: AlignParams,
    /// Maps whose poses are known, more or less.
    pub poses: Vec<KnownPose>,
    /// What searches between two maps found that were done elsewhere: these pairs are not searched.
    pub alignments: Vec<PairAlignment>,
    /// The map in whose frame the others are given; a component without it is given in the frame
    /// of its first map. 0 by default.
    pub reference: usize,
}

/// Where a map lies in the frame of the reference, and how far to believe it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownPose {
    /// Which map, from 0.
    pub map: usize,
    /// Its pose.
    pub reference_from_map: Se2,
    /// Standard deviation of its translation, metres; 0, of the rotation too, takes the pose as
    /// given: nothing is searched and nothing is doubted.
    pub sigma_m: f64,
    /// Standard deviation of its rotation, radians.
    pub sigma_rad: f64,
}

/// What the search between two maps of a team found.
#[derive(Debug, Clone, PartialEq)]
pub struct PairAlignment {
    /// Which map was the target, from 0.
    pub target: usize,
    /// Which map was the source.
    pub source: usize,
    /// [`PairReport::hypotheses`](crate::PairReport::hypotheses): distinct poses, best first.
    pub hypotheses: Vec<Hypothesis>,
}

impl KnownPose {
    pub(crate) fn is_given(&self) -> bool {
        self.sigma_m == 0.0 && self.sigma_rad == 0.0
    }
}

impl TeamParams {
    pub(crate) fn check(&self, maps: usize) -> Result<(), MergeError> {
        let aligned = self.alignments.iter().flat_map(|pair| [pair.target, pair.source]);
        let posed = self.poses.iter().map(|pose| pose.map);
        let named = posed.chain(aligned).chain([self.reference]);
        if let Some(map) = named.into_iter().find(|&map| map >= maps && maps > 0) {
            return Err(MergeError::NoSuchMap { map, maps });
        }
        for pose in &self.poses {
            pose.reference_from_map.check_finite()?;
            not_negative("pose.sigma_m", pose.sigma_m)?;
            not_negative("pose.sigma_rad", pose.sigma_rad)?;
        }
        self.alignments.iter().try_for_each(PairAlignment::check)
    }

    /// What is known about where `map` lies.
    pub(crate) fn known(&self, map: usize) -> Option<KnownPose> {
        let reference = KnownPose {
            map: self.reference,
            reference_from_map: Se2::identity(),
            sigma_m: 0.0,
            sigma_rad: 0.0,
        };
        if map == self.reference {
            return Some(reference);
        }
        self.poses.iter().copied().find(|pose| pose.map == map)
    }
}

impl PairAlignment {
    fn check(&self) -> Result<(), MergeError> {
        let (target, source) = (self.target, self.source);
        require(
            target != source,
            "alignment.source",
            "another map than the target",
            source as f64,
        )?;
        for found in &self.hypotheses {
            found.target_from_source.check_finite()?;
            let probability = found.probability.unwrap_or(0.0);
            let is_share = (0.0..=1.0).contains(&probability);
            require(is_share, "alignment.probability", "in [0, 1]", probability)?;
            require(found.score.is_finite(), "alignment.score", "finite", found.score)?;
            let is_spread = |covariance: &Matrix3<f64>| {
                covariance.iter().all(|entry| entry.is_finite())
                    && covariance.diagonal().min() >= 0.0
            };
            let covariance = found.covariance.unwrap_or_default();
            let least = covariance.diagonal().min();
            require(is_spread(&covariance), "alignment.covariance", "finite, not negative", least)?;
        }
        Ok(())
    }
}

fn not_negative(name: &'static str, value: f64) -> Result<(), ParameterError> {
    require(value.is_finite() && value >= 0.0, name, "finite and not below 0", value)
}
