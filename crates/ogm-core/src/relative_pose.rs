//! Where one map lies in another, and how sure that is.

use nalgebra::Matrix3;

use crate::Se2;

/// The motion between two map frames with its uncertainty: what a matcher gives and a pose graph
/// takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePose {
    /// Maps points of the source map into the target map.
    pub target_from_source: Se2,
    /// Covariance of the translation along the target's axes, metres, and of the rotation,
    /// radians: (x, y, θ), given that the pose is right.
    pub covariance: Matrix3<f64>,
    /// Probability that the pose is right, in [0, 1].
    pub probability: f64,
}

impl RelativePose {
    /// The same knowledge seen from the source: `source_from_target`.
    ///
    /// The covariance is carried over to first order.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let source_from_target = self.target_from_source.inverse();
        let (sin, cos) = source_from_target.theta().sin_cos();
        let shift = source_from_target.translation();
        // Of (x, y, θ) of the inverse by those of the motion: t' = −R(−θ) t, θ' = −θ.
        let jacobian = Matrix3::new(-cos, sin, shift.y, -sin, -cos, -shift.x, 0.0, 0.0, -1.0);
        let covariance = jacobian * self.covariance * jacobian.transpose();
        Self {
            target_from_source: source_from_target,
            // Symmetric to the last bit, which rounding is not.
            covariance: 0.5 * (covariance + covariance.transpose()),
            probability: self.probability,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::RelativePose;
    use crate::Se2;
    use nalgebra::{Matrix3, Vector3};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use std::f64::consts::PI;

    fn moved(pose: Se2, by: Vector3<f64>) -> Se2 {
        Se2::new(pose.x() + by.x, pose.y() + by.y, pose.theta() + by.z)
    }

    proptest! {
        #[test]
        fn the_covariance_of_the_inverse_is_that_of_its_small_motions(
            x in -20.0_f64..20.0, y in -20.0_f64..20.0, theta in -3.0_f64..3.0,
            dx in -1.0_f64..1.0, dy in -1.0_f64..1.0, turn in -1.0_f64..1.0,
        ) {
            let target_from_source = Se2::new(x, y, theta);
            let step = 1e-5 * Vector3::new(dx, dy, turn);
            let pose = RelativePose {
                target_from_source,
                covariance: step * step.transpose(),
                probability: 0.5,
            };
            let inverse = pose.inverse();
            prop_assert_eq!(inverse.covariance, inverse.covariance.transpose());
            let there = moved(target_from_source, step).inverse();
            let here = inverse.target_from_source;
            let change = Vector3::new(
                there.x() - here.x(),
                there.y() - here.y(),
                there.theta() - here.theta(),
            );
            let difference = inverse.covariance - change * change.transpose();
            prop_assert!(difference.norm() < 1e-3 * (1e-12 + inverse.covariance.norm()));
        }

        #[test]
        fn twice_inverted_is_the_same(x in -20.0_f64..20.0, theta in -PI..PI) {
            let covariance = Matrix3::new(4.0, 1.0, 0.1, 1.0, 3.0, 0.2, 0.1, 0.2, 0.5);
            let pose = RelativePose {
                target_from_source: Se2::new(x, -x, theta),
                covariance,
                probability: 0.5,
            };
            prop_assert!((pose.inverse().inverse().covariance - covariance).norm() < 1e-9);
        }
    }
}
