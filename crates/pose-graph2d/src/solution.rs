//! What a solved graph says.

use nalgebra::Matrix3;
use ogm_core::Se2;

/// The poses of a graph, and what became of its edges.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Solution {
    /// Nodes that hang together, in the order of their first nodes; a node that nothing holds is
    /// alone.
    pub components: Vec<Component>,
    /// What became of every hypothesis of every edge, in their order.
    pub verdicts: Vec<Vec<Verdict>>,
}

/// Nodes that hang together.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// In whose frame the poses are given.
    pub reference: usize,
    /// Every node of it, in ascending order.
    pub nodes: Vec<PlacedNode>,
    /// Sum of the squared Mahalanobis distances of the hypotheses used: twice the negative log
    /// likelihood.
    pub cost: f64,
    /// Whether the least squares converged within the steps allowed.
    pub is_converged: bool,
}

/// A node in its component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedNode {
    /// Which node, from 0.
    pub node: usize,
    /// Maps its points into the frame of the reference.
    pub reference_from_node: Se2,
    /// Covariance of (x, y, θ) in the axes of the reference, m², m·rad, rad², given that the
    /// hypotheses used are right; zero for the reference, `None` where it was not asked for.
    pub covariance: Option<Matrix3<f64>>,
}

/// What became of a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// It holds the poses.
    Used {
        /// Its squared Mahalanobis distance from them.
        distance_sq: f64,
    },
    /// It contradicts the others.
    Contradicted {
        /// Its squared Mahalanobis distance from the poses without it.
        distance_sq: f64,
    },
    /// Another hypothesis of the same edge agrees better.
    Outranked,
    /// It alone would hold two parts together, and is not sure enough for that.
    Unconfirmed {
        /// Its probability.
        probability: f64,
    },
}

impl Verdict {
    /// Whether the hypothesis holds the poses.
    #[must_use]
    pub fn is_used(&self) -> bool {
        matches!(self, Self::Used { .. })
    }
}
