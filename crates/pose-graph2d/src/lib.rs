//! Poses of many frames in the plane from uncertain relative ones, some of which are wrong.
//!
//! A [`PoseGraph`] says what is known about pairs of frames: every [`Edge`] has one or several
//! hypotheses, each a [`RelativePose`](ogm_core::RelativePose) with its covariance and probability.
//! [`solve`] finds which of them agree, the poses that fit these best, how sure they are, and why
//! each of the others was rejected. It needs no start.
//!
//! ```
//! use nalgebra::Matrix3;
//! use ogm_core::{RelativePose, Se2};
//! use pose_graph2d::{Edge, PoseGraph, SolveParams, Verdict, solve};
//!
//! let edge = |target, source, poses: &[(f64, f64)]| Edge {
//!     target,
//!     source,
//!     hypotheses: poses
//!         .iter()
//!         .map(|&(x, probability)| RelativePose {
//!             target_from_source: Se2::new(x, 0.0, 0.0),
//!             covariance: Matrix3::from_diagonal_element(1e-4),
//!             probability,
//!         })
//!         .collect(),
//! };
//! // Rooms that repeat every 5 m: the likelier hypothesis of the last edge contradicts the loop.
//! let graph = PoseGraph {
//!     nodes: 3,
//!     edges: vec![
//!         edge(0, 1, &[(5.0, 0.9)]),
//!         edge(1, 2, &[(5.0, 0.9)]),
//!         edge(0, 2, &[(5.0, 0.6), (10.0, 0.4)]),
//!     ],
//! };
//! let solution = solve(&graph, &SolveParams::default(), &())?;
//! let [component] = &solution.components[..] else { panic!("all hang together") };
//! assert!((component.nodes[2].reference_from_node.x() - 10.0).abs() < 1e-9);
//! assert_eq!(solution.verdicts[2][0], Verdict::Outranked);
//! # Ok::<(), pose_graph2d::GraphError>(())
//! ```
//!
//! Least squares by Levenberg–Marquardt from a chordal start; the normal equations are dense for
//! small graphs and sparse, with the feature `faer`, for large ones. [`G2oGraph`] reads and writes
//! the format of g2o.

mod blocks;
mod candidate;
mod components;
mod consistent;
mod constraint;
mod error;
mod g2o;
mod graduated;
mod graph;
mod optimise;
mod params;
mod solution;
mod solve;
#[cfg(feature = "faer")]
mod sparse;
mod start;

pub use error::GraphError;
pub use g2o::G2oGraph;
pub use graph::{Edge, PoseGraph};
/// The poses that the functions here take and give.
pub use ogm_core;
pub use params::{RotationError, Selection, SolveParams};
pub use solution::{Component, PlacedNode, Solution, Verdict};
pub use solve::solve;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
