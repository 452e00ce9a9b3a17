//! What cannot be meant as a pose graph.

use ogm_core::{Cancelled, GridError, ParameterError};

/// A graph, parameters or a file that cannot be meant, or a call that was ended.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GraphError {
    /// An edge to a node that is not there.
    #[error("edge {edge}, counted from 0, names node {node} where there are {nodes} nodes")]
    NoSuchNode {
        /// Which edge.
        edge: usize,
        /// The node.
        node: usize,
        /// How many there are.
        nodes: usize,
    },
    /// An edge from a node to itself.
    #[error("edge {edge}, counted from 0, joins node {node} to itself")]
    SameNode {
        /// Which edge.
        edge: usize,
        /// The node.
        node: usize,
    },
    /// A covariance that is not symmetric and positive definite.
    #[error(
        "a covariance of edge {edge}, counted from 0, is not symmetric and positive definite; where nothing is known, give a large variance"
    )]
    NotACovariance {
        /// Which edge.
        edge: usize,
    },
    /// A probability outside [0, 1].
    #[error("a probability of edge {edge}, counted from 0, is {probability}, not in [0, 1]")]
    NotAProbability {
        /// Which edge.
        edge: usize,
        /// What it is.
        probability: f64,
    },
    /// Too many nodes in one component for the dense solver.
    #[error(
        "{nodes} nodes hang together and without the feature `faer` at most {most} can be solved"
    )]
    TooLarge {
        /// How many.
        nodes: usize,
        /// How many can be solved.
        most: usize,
    },
    /// Covariances so far apart in size that no digits are left.
    #[error("the normal equations are not positive definite: the covariances differ too much")]
    Singular,
    /// A line of a g2o file.
    #[error("line {line} of the g2o file: {what}")]
    G2o {
        /// Which line, from 1.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
    /// A pose with a NaN or infinite part.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The call was asked to end.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
