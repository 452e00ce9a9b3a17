//! Least squares over the poses of one component, by Levenberg–Marquardt.
//!
//! Levenberg's damping as a share of the diagonal, by Marquardt, *An Algorithm for Least-Squares
//! Estimation of Nonlinear Parameters* (1963); it starts undamped, as Gauss–Newton.

use nalgebra::{DMatrix, Matrix3, Vector2, Vector3};
use ogm_core::Progress;

use crate::blocks::{BlockMatrix, Solver, block};
use crate::constraint::{Constraint, Pose};
use crate::error::GraphError;
use crate::params::RotationError;

/// A step that promises to lower the cost by a smaller share is the last.
const LEAST_DECREASE: f64 = 1e-9;
/// A cost of so little a constraint is rounding.
const ROUNDING: f64 = 1e-16;
/// First damping after a step that raised the cost, and what damping is worth keeping.
const FIRST_DAMPING: f64 = 1e-4;
const LEAST_DAMPING: f64 = 1e-9;
/// With more damping than this nothing moves.
const MOST_DAMPING: f64 = 1e12;

/// Poses at a minimum.
pub(crate) struct Optimum {
    pub(crate) poses: Vec<Pose>,
    pub(crate) cost: f64,
    pub(crate) is_converged: bool,
}

/// The problem of one component, node 0 at the identity.
pub(crate) struct Problem<'a> {
    pub(crate) constraints: &'a [Constraint],
    pub(crate) rotation_error: RotationError,
}

impl Problem<'_> {
    pub(crate) fn cost(&self, poses: &[Pose]) -> f64 {
        let terms = self.constraints.iter();
        terms.map(|constraint| constraint.distance_sq(poses, self.rotation_error)).sum()
    }

    /// The minimum near `poses`, in at most `max_iterations` steps.
    pub(crate) fn minimise(
        &self,
        mut poses: Vec<Pose>,
        max_iterations: usize,
        progress: &dyn Progress,
    ) -> Result<Optimum, GraphError> {
        let mut cost = self.cost(&poses);
        let mut is_converged = poses.len() < 2;
        if is_converged {
            return Ok(Optimum { poses, cost, is_converged });
        }
        let mut matrix = self.pattern(poses.len());
        let solver = Solver::new(&matrix)?;
        let rounding = ROUNDING * self.constraints.len() as f64;
        let mut damping = 0.0;
        for iteration in 0..max_iterations {
            progress.go_on(iteration as f64 / max_iterations as f64)?;
            let gradient = self.linearise(&poses, &mut matrix);
            let (moved, new_cost, promised) = loop {
                let values = matrix.damped(damping);
                let tried = solver.factorise(&matrix, &values).map(|factor| {
                    let mut step = gradient.clone();
                    factor.solve(&mut step);
                    let promised = step.dot(&gradient);
                    let moved = moved(&poses, &step);
                    let new_cost = self.cost(&moved);
                    (moved, new_cost, promised)
                });
                if let Some(tried) = tried.filter(|(_, new_cost, promised)| {
                    *new_cost <= cost || *promised <= LEAST_DECREASE * cost + rounding
                }) {
                    break tried;
                }
                damping = if damping == 0.0 { FIRST_DAMPING } else { 10.0 * damping };
                if damping > MOST_DAMPING {
                    return Err(GraphError::Singular);
                }
            };
            is_converged = damping <= FIRST_DAMPING && promised <= LEAST_DECREASE * cost + rounding;
            if new_cost <= cost {
                (poses, cost) = (moved, new_cost);
            }
            if is_converged {
                break;
            }
            damping = if damping <= LEAST_DAMPING { 0.0 } else { 0.1 * damping };
        }
        Ok(Optimum { poses, cost, is_converged })
    }

    /// Covariance of (x, y, θ) of every node, given node 0.
    pub(crate) fn covariances(&self, poses: &[Pose]) -> Result<Vec<Matrix3<f64>>, GraphError> {
        let mut found = vec![Matrix3::zeros()];
        if poses.len() > 1 {
            let mut matrix = self.pattern(poses.len());
            self.linearise(poses, &mut matrix);
            let factor = Solver::new(&matrix)?.factorise(&matrix, &matrix.values);
            found.extend(factor.ok_or(GraphError::Singular)?.inverse_blocks::<3>(matrix.order()));
        }
        Ok(found)
    }

    fn pattern(&self, nodes: usize) -> BlockMatrix<3> {
        let unknown = |node: usize| node.checked_sub(1);
        let constraints = self.constraints.iter();
        let pairs = constraints.filter_map(|c| unknown(c.target).zip(unknown(c.source)));
        BlockMatrix::new(nodes - 1, pairs)
    }

    /// Normal equations into `matrix`; the direction of descent.
    fn linearise(&self, poses: &[Pose], matrix: &mut BlockMatrix<3>) -> DMatrix<f64> {
        matrix.clear();
        let mut descent = DMatrix::zeros(matrix.order(), 1);
        for constraint in self.constraints {
            let linear = constraint.linear(poses, self.rotation_error);
            let sides = [
                (constraint.target.checked_sub(1), linear.by_target),
                (constraint.source.checked_sub(1), linear.by_source),
            ];
            for (node, by_node) in &sides {
                let Some(node) = *node else { continue };
                let weighted = by_node.transpose() * constraint.information;
                matrix.add_diagonal(node, &(weighted * by_node));
                let pull: Vector3<f64> = weighted * linear.residual;
                for row in 0..3 {
                    descent[(3 * node + row, 0)] -= pull[row];
                }
            }
            let [(target, by_target), (source, by_source)] = sides;
            if let Some((target, source)) = target.zip(source) {
                let across = by_source.transpose() * constraint.information * by_target;
                matrix.add(source, target, &across);
            }
        }
        descent
    }
}

fn moved(poses: &[Pose], step: &DMatrix<f64>) -> Vec<Pose> {
    let mut moved = poses.to_vec();
    for (node, pose) in moved.iter_mut().skip(1).enumerate() {
        let by: Vector3<f64> = block(step, node);
        pose.at += Vector2::new(by.x, by.y);
        pose.theta += by.z;
    }
    moved
}
