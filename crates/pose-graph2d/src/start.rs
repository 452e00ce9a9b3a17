//! Poses from no start: rotations without their constraint, then translations.
//!
//! The chordal relaxation of Martinec and Pajdla, *Robust Rotation and Translation Estimation in
//! Multiview Reconstruction* (2007), as compared by Carlone, Tron, Daniilidis, Dellaert,
//! *Initialization Techniques for 3D SLAM* (2015).

use nalgebra::{DMatrix, Matrix2, Vector2};

use crate::blocks::{BlockMatrix, Solver, block};
use crate::constraint::{Constraint, Pose};
use crate::error::GraphError;

/// Poses of `nodes` nodes that `constraints` hold together, node 0 at the identity.
pub(crate) fn start(nodes: usize, constraints: &[Constraint]) -> Result<Vec<Pose>, GraphError> {
    let angles = rotations(nodes, constraints)?;
    translations(&angles, constraints)
}

/// Unknowns of a node; the first has none.
fn unknown(node: usize) -> Option<usize> {
    node.checked_sub(1)
}

fn pattern(nodes: usize, constraints: &[Constraint]) -> BlockMatrix<2> {
    let pairs = constraints.iter().filter_map(|c| unknown(c.target).zip(unknown(c.source)));
    BlockMatrix::new(nodes - 1, pairs)
}

/// Least squares of Σ κ |r_s − R_ts r_t|² over vectors r of any length, r_0 = (1, 0).
fn rotations(nodes: usize, constraints: &[Constraint]) -> Result<Vec<f64>, GraphError> {
    let mut matrix = pattern(nodes, constraints);
    let mut right = DMatrix::zeros(matrix.order(), 1);
    for constraint in constraints {
        let weight = constraint.information[(2, 2)];
        let (sin, cos) = constraint.theta.sin_cos();
        let turn = weight * Matrix2::new(cos, -sin, sin, cos);
        let own = weight * Matrix2::identity();
        let [target, source] = [constraint.target, constraint.source].map(unknown);
        for node in [target, source].into_iter().flatten() {
            matrix.add_diagonal(node, &own);
        }
        match (target, source) {
            (Some(target), Some(source)) => matrix.add(source, target, &-turn),
            (None, Some(source)) => add(&mut right, source, turn * Vector2::x()),
            (Some(target), None) => add(&mut right, target, turn.transpose() * Vector2::x()),
            (None, None) => {}
        }
    }
    solve(&matrix, &mut right)?;
    let angle = |node: usize| {
        let direction: Vector2<f64> = block(&right, node);
        f64::atan2(direction.y, direction.x)
    };
    Ok(std::iter::once(0.0).chain((0..nodes - 1).map(angle)).collect())
}

/// Translations of least squares where the rotations stay.
fn translations(angles: &[f64], constraints: &[Constraint]) -> Result<Vec<Pose>, GraphError> {
    let mut matrix = pattern(angles.len(), constraints);
    let mut right = DMatrix::zeros(matrix.order(), 1);
    let mut poses: Vec<Pose> =
        angles.iter().map(|&theta| Pose { at: Vector2::zeros(), theta }).collect();
    for constraint in constraints {
        let (sin, cos) = poses[constraint.target].theta.sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        let residual = constraint.residual(&poses, crate::params::RotationError::Angle);
        let information = turn * constraint.information.fixed_view::<2, 2>(0, 0) * turn.transpose();
        let pull = turn * (constraint.information * residual).xy();
        let [target, source] = [constraint.target, constraint.source].map(unknown);
        for (node, pull) in [(target, pull), (source, -pull)] {
            if let Some(node) = node {
                matrix.add_diagonal(node, &information);
                add(&mut right, node, pull);
            }
        }
        if let (Some(target), Some(source)) = (target, source) {
            matrix.add(source, target, &-information);
        }
    }
    solve(&matrix, &mut right)?;
    for (node, pose) in poses.iter_mut().skip(1).enumerate() {
        pose.at = block(&right, node);
    }
    Ok(poses)
}

fn add(right: &mut DMatrix<f64>, node: usize, value: Vector2<f64>) {
    right[(2 * node, 0)] += value.x;
    right[(2 * node + 1, 0)] += value.y;
}

fn solve(matrix: &BlockMatrix<2>, right: &mut DMatrix<f64>) -> Result<(), GraphError> {
    if matrix.order() == 0 {
        return Ok(());
    }
    let factor = Solver::new(matrix)?.factorise(matrix, &matrix.values);
    factor.ok_or(GraphError::Singular)?.solve(right);
    Ok(())
}
