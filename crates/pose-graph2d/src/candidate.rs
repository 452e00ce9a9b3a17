//! Hypotheses of all edges in one row, for selection.

use nalgebra::Matrix3;
use ogm_core::RelativePose;

use crate::constraint::Constraint;
use crate::error::GraphError;
use crate::graph::{PoseGraph, information};

/// No hypothesis but a given one has more evidence than this.
const MOST_EVIDENCE: f64 = 12.0;

/// One hypothesis of one edge.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub(crate) edge: usize,
    pub(crate) target: usize,
    pub(crate) source: usize,
    pub(crate) pose: RelativePose,
    pub(crate) information: Matrix3<f64>,
}

impl Candidate {
    /// Every hypothesis, edge after edge.
    pub(crate) fn all(graph: &PoseGraph) -> Result<Vec<Self>, GraphError> {
        let mut found = Vec::new();
        for (index, edge) in graph.edges.iter().enumerate() {
            for pose in &edge.hypotheses {
                let information = information(&pose.covariance)
                    .ok_or(GraphError::NotACovariance { edge: index })?;
                let (target, source) = (edge.target, edge.source);
                found.push(Self { edge: index, target, source, pose: *pose, information });
            }
        }
        Ok(found)
    }

    /// Whether it is taken as given.
    pub(crate) fn is_given(&self) -> bool {
        self.pose.probability >= 1.0
    }

    /// What it costs to call it wrong: −ln(1 − p).
    pub(crate) fn evidence(&self) -> f64 {
        let evidence = -(-self.pose.probability).ln_1p();
        if self.is_given() { 2.0 * MOST_EVIDENCE } else { evidence.min(MOST_EVIDENCE) }
    }

    /// The term of the cost, where `local` numbers its nodes.
    pub(crate) fn constraint(&self, local: impl Fn(usize) -> usize) -> Constraint {
        let target_from_source = self.pose.target_from_source;
        Constraint {
            target: local(self.target),
            source: local(self.source),
            translation: target_from_source.translation(),
            theta: target_from_source.theta(),
            information: self.information,
        }
    }
}

/// The candidates of one group of nodes.
pub(crate) struct Members<'a> {
    /// Those of all groups.
    pub(crate) candidates: &'a [Candidate],
    /// Which of them.
    pub(crate) indices: &'a [usize],
    /// Nodes of the group.
    pub(crate) nodes: usize,
    /// The place of a node in the group.
    pub(crate) local: &'a dyn Fn(usize) -> usize,
}
