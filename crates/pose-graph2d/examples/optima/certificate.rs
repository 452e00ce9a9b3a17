//! How far from the best of all poses some poses can be at most.
//!
//! Over complex numbers t for translations and z of modulus 1 for rotations the cost with
//! `RotationError::Chord` is a Hermitian form x* M x (Rosen et al., *SE-Sync*, 2019). With
//! λ = Re(z̄ (M x)) and S = M − diag(λ) over the rotations, every w of modulus 1 costs
//! w* S w + Σ λ. Turn and shift w until it agrees with x at node 0: what they differ by there is
//! zero, v elsewhere. With r = S x and the submatrix C of S without node 0,
//! cost(w) − cost(x) = 2 Re(r* v) + v* C v, which is nowhere less than −r* C⁻¹ r if C is positive
//! definite. That C has a Cholesky factor, a little lowered, proves this beyond rounding.

use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side, c64};
use ogm_core::Se2;
use pose_graph2d::PoseGraph;

/// The diagonal is lowered by this share before it is factorised: far more than the rounding of the
/// factorisation, and far less than what a graph's longest loop leaves.
const LOWERED: f64 = 1e-13;

/// What the dual says about poses.
pub(crate) struct Certificate {
    pub(crate) cost: f64,
    /// No poses cost less than `cost` by more than this; `None` where the dual says nothing.
    pub(crate) gap: Option<f64>,
}

/// The certificate of poses of a graph without alternatives whose covariances are diagonal and
/// equal in x and y.
pub(crate) fn certificate(graph: &PoseGraph, world_from_node: &[Se2]) -> Certificate {
    let nodes = graph.nodes;
    let form = form(graph);
    let places = world_from_node.iter().map(|pose| c64::new(pose.x(), pose.y()));
    let turns = world_from_node.iter().map(|pose| cis(pose.theta()));
    let x: Vec<c64> = places.chain(turns).collect();
    let mut image = vec![c64::new(0.0, 0.0); x.len()];
    for &Triplet { row, col, val } in &form {
        image[row] += val * x[col];
    }
    let cost: f64 = x.iter().zip(&image).map(|(x, image)| (x.conj() * image).re).sum();
    let mut dual = form;
    for node in nodes..2 * nodes {
        let multiplier = (x[node].conj() * image[node]).re;
        image[node] -= x[node] * multiplier;
        dual.push(Triplet::new(node, node, c64::new(-multiplier, 0.0)));
    }
    Certificate { cost, gap: gap(dual, &image, nodes) }
}

/// r* C⁻¹ r of S and r; `None` where C is not positive definite.
fn gap(dual: Vec<Triplet<usize, usize, c64>>, residual: &[c64], nodes: usize) -> Option<f64> {
    // Without translation and rotation of node 0.
    let place = |index: usize| match index {
        0 => None,
        _ if index == nodes => None,
        _ => Some(index - 1 - usize::from(index > nodes)),
    };
    let mut kept: Vec<_> = dual
        .into_iter()
        .filter_map(|Triplet { row, col, val }| Some(Triplet::new(place(row)?, place(col)?, val)))
        .collect();
    let on_diagonal = kept.iter().filter(|entry| entry.row == entry.col);
    let lowered = on_diagonal.map(|entry| Triplet { val: -LOWERED * entry.val, ..*entry });
    let lowered: Vec<_> = lowered.collect();
    kept.extend(lowered);
    let order = 2 * nodes - 2;
    let matrix = SparseColMat::<usize, c64>::try_new_from_triplets(order, order, &kept).ok()?;
    let factor = matrix.sp_cholesky(Side::Lower).ok()?;
    let mut right = Mat::<c64>::zeros(order, 1);
    for (index, value) in residual.iter().enumerate() {
        if let Some(place) = place(index) {
            right[(place, 0)] = *value;
        }
    }
    let solved = factor.solve(&right);
    Some((0..order).map(|row| (right[(row, 0)].conj() * solved[(row, 0)]).re).sum())
}

fn cis(angle: f64) -> c64 {
    c64::new(angle.cos(), angle.sin())
}

/// M, translations before rotations, as summands of its entries.
fn form(graph: &PoseGraph) -> Vec<Triplet<usize, usize, c64>> {
    let mut form = Vec::with_capacity(13 * graph.edges.len());
    for edge in &graph.edges {
        let pose = &edge.hypotheses[0];
        let [tau, kappa] = [(0, 0), (2, 2)].map(|at| 1.0 / pose.covariance[at]);
        let motion = pose.target_from_source;
        let (turn, shift) = (cis(motion.theta()), c64::new(motion.x(), motion.y()));
        let one = c64::new(1.0, 0.0);
        let (t, z) = (|node: usize| node, |node: usize| graph.nodes + node);
        let rotation = [(z(edge.source), one), (z(edge.target), -turn)];
        let translation = [(t(edge.source), one), (t(edge.target), -one), (z(edge.target), -shift)];
        for (weight, residual) in [(kappa, &rotation[..]), (tau, &translation[..])] {
            for &(row, a) in residual {
                for &(column, b) in residual {
                    form.push(Triplet::new(row, column, a.conj() * b * weight));
                }
            }
        }
    }
    form
}
