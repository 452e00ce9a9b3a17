//! What is known about pairs of frames.

use nalgebra::Matrix3;
use ogm_core::RelativePose;

use crate::error::GraphError;

/// What is known about where one node lies in another.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// The node whose frame the poses are given in, from 0.
    pub target: usize,
    /// The node that they place in it, from 0.
    pub source: usize,
    /// The ways in which it may lie there: one of them is right, or none. A probability of 1 is
    /// taken as given and never rejected: odometry, a surveyed pose.
    pub hypotheses: Vec<RelativePose>,
}

/// Frames, numbered from 0, and what is known about pairs of them.
///
/// A known pose or a landmark is an edge like any other: the world, or the landmark, is a node. A
/// landmark without a heading has a large variance of θ.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PoseGraph {
    /// How many frames there are.
    pub nodes: usize,
    /// What is known about pairs of them; several edges of one pair are independent observations.
    pub edges: Vec<Edge>,
}

impl PoseGraph {
    pub(crate) fn check(&self) -> Result<(), GraphError> {
        for (index, edge) in self.edges.iter().enumerate() {
            let Edge { target, source, hypotheses } = edge;
            if let Some(&node) = [target, source].into_iter().find(|&&node| node >= self.nodes) {
                return Err(GraphError::NoSuchNode { edge: index, node, nodes: self.nodes });
            }
            if target == source {
                return Err(GraphError::SameNode { edge: index, node: *target });
            }
            for pose in hypotheses {
                pose.target_from_source.check_finite()?;
                if information(&pose.covariance).is_none() {
                    return Err(GraphError::NotACovariance { edge: index });
                }
                let probability = pose.probability;
                if !(0.0..=1.0).contains(&probability) {
                    return Err(GraphError::NotAProbability { edge: index, probability });
                }
            }
        }
        Ok(())
    }
}

/// The inverse of a covariance; `None` of what is none.
pub(crate) fn information(covariance: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let is_symmetric = (covariance - covariance.transpose()).amax() <= 1e-6 * covariance.amax();
    let inverse = is_symmetric.then(|| covariance.cholesky())??.inverse();
    let is_finite = covariance.iter().chain(&inverse).all(|value| value.is_finite());
    is_finite.then_some(inverse)
}
