//! Errors of a transform: of one pose, and over the walls.

use nalgebra::{Point2, Vector3};
use ogm_core::{RelativePose, Se2, wrap_angle};

/// The paper's pixel, metres.
pub(crate) const PIXEL: f64 = 0.02;

/// How far an estimated pose is from the true one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PoseError {
    /// Displacement of one reference point, or root mean square over an area, metres.
    pub(crate) displacement: f64,
    /// Absolute rotation error, radians.
    pub(crate) turn: f64,
}

impl PoseError {
    /// The error as a share of so many times itself.
    pub(crate) fn over(self, times: f64) -> Self {
        Self { displacement: self.displacement / times, turn: self.turn / times }
    }

    /// The error at `point`, source frame.
    pub(crate) fn at(
        point: Point2<f64>,
        estimated_target_from_source: &Se2,
        true_target_from_source: &Se2,
    ) -> Self {
        let displacement =
            (*estimated_target_from_source * point - *true_target_from_source * point).norm();
        let turn =
            wrap_angle(estimated_target_from_source.theta() - true_target_from_source.theta());
        Self { displacement, turn: turn.abs() }
    }
}

/// How far an estimated transform is from the true one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TransformError {
    /// Mean squared displacement of the source's walls in the true overlap, px² of 0.02 m.
    pub(crate) mse_disp: f64,
    /// Mean squared distance of those walls to the nearest wall of the target, px² of 0.02 m.
    pub(crate) mse_nn: f64,
    /// The error of the pose.
    pub(crate) pose: PoseError,
}

impl TransformError {
    /// The error of a pose over an area, where walls were not looked at.
    pub(crate) fn over_area(pose: PoseError) -> Self {
        Self { mse_disp: (pose.displacement / PIXEL).powi(2), mse_nn: f64::NAN, pose }
    }
}

/// Squared error of a pose in units of its own covariance over (x, y, θ): of three degrees of
/// freedom, so 95 % lie below [`NEES_95`]. `None` for a covariance without an inverse.
pub(crate) fn nees(pose: &RelativePose, true_target_from_source: &Se2) -> Option<f64> {
    let (found, truth) = (&pose.target_from_source, true_target_from_source);
    let error = Vector3::new(
        found.x() - truth.x(),
        found.y() - truth.y(),
        wrap_angle(found.theta() - truth.theta()),
    );
    Some((error.transpose() * pose.covariance.try_inverse()? * error)[0])
}

/// 95 % quantile of χ² with three degrees of freedom.
pub(crate) const NEES_95: f64 = 7.815;
