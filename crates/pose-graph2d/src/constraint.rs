//! One relative pose as a term of the cost.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use ogm_core::{Se2, wrap_angle};

use crate::params::RotationError;

/// A pose as the optimiser moves it: its angle is free to leave [−π, π).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) at: Vector2<f64>,
    pub(crate) theta: f64,
}

impl From<Pose> for Se2 {
    fn from(pose: Pose) -> Self {
        Self::new(pose.at.x, pose.at.y, pose.theta)
    }
}

/// A hypothesis that takes part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constraint {
    pub(crate) target: usize,
    pub(crate) source: usize,
    pub(crate) translation: Vector2<f64>,
    pub(crate) theta: f64,
    pub(crate) information: Matrix3<f64>,
}

/// Residual of a constraint and its derivatives by (x, y, θ) of both nodes.
pub(crate) struct Linear {
    pub(crate) residual: Vector3<f64>,
    pub(crate) by_target: Matrix3<f64>,
    pub(crate) by_source: Matrix3<f64>,
}

fn rotation(theta: f64) -> Matrix2<f64> {
    let (sin, cos) = theta.sin_cos();
    Matrix2::new(cos, -sin, sin, cos)
}

impl Constraint {
    fn turn(&self, poses: &[Pose]) -> f64 {
        wrap_angle(poses[self.source].theta - poses[self.target].theta - self.theta)
    }

    /// Translation in target axes, then rotation.
    pub(crate) fn residual(&self, poses: &[Pose], error: RotationError) -> Vector3<f64> {
        let [target, source] = [&poses[self.target], &poses[self.source]];
        let shift = rotation(target.theta).transpose() * (source.at - target.at);
        let off = shift - self.translation;
        let turn = self.turn(poses);
        let turn = match error {
            RotationError::Angle => turn,
            RotationError::Chord => 2.0 * (turn / 2.0).sin(),
        };
        Vector3::new(off.x, off.y, turn)
    }

    pub(crate) fn distance_sq(&self, poses: &[Pose], error: RotationError) -> f64 {
        let residual = self.residual(poses, error);
        residual.dot(&(self.information * residual))
    }

    pub(crate) fn linear(&self, poses: &[Pose], error: RotationError) -> Linear {
        let [target, source] = [&poses[self.target], &poses[self.source]];
        let turned = rotation(target.theta).transpose();
        let shift = turned * (source.at - target.at);
        let slope = match error {
            RotationError::Angle => 1.0,
            RotationError::Chord => (self.turn(poses) / 2.0).cos(),
        };
        let [m11, m12, m21, m22] = [turned.m11, turned.m12, turned.m21, turned.m22];
        Linear {
            residual: self.residual(poses, error),
            by_target: Matrix3::new(-m11, -m12, shift.y, -m21, -m22, -shift.x, 0.0, 0.0, -slope),
            by_source: Matrix3::new(m11, m12, 0.0, m21, m22, 0.0, 0.0, 0.0, slope),
        }
    }
}
