//! Poses in space that are poses on the floor.

use nalgebra::Vector3;
use ogm_core::{GridError, Se2};

use super::basic::{Point, Pose, Quaternion};
use super::error::MessageError;

/// Steepest z axis that is taken for a map on a floor: 1°. Estimators that drift in roll and pitch
/// stay below it.
const MOST_TILT: f64 = std::f64::consts::PI / 180.0;

impl Pose {
    /// The pose on the floor; its height is ignored, and a quaternion of zeros, which many programs
    /// leave there, is no turn.
    ///
    /// # Errors
    /// A number that is not finite, or a z axis more than 1° off the vertical.
    pub fn flat(&self) -> Result<Se2, MessageError> {
        let Quaternion { x, y, z, w } = self.orientation;
        let [qx, qy, qz, qw] = [x, y, z, w];
        let norm_sq = qx * qx + qy * qy + qz * qz + qw * qw;
        let theta = if norm_sq == 0.0 {
            0.0
        } else {
            // The third column of the rotation matrix, times the norm.
            let up = Vector3::new(
                2.0 * (qx * qz + qw * qy),
                2.0 * (qy * qz - qw * qx),
                qw * qw - qx * qx - qy * qy + qz * qz,
            );
            let tilt = up.xy().norm().atan2(up.z);
            if tilt > MOST_TILT {
                return Err(MessageError::Tilted { degrees: tilt.to_degrees() });
            }
            (2.0 * (qw * qz + qx * qy)).atan2(qw * qw + qx * qx - qy * qy - qz * qz)
        };
        let pose = Se2::new(self.position.x, self.position.y, theta);
        pose.check_finite().map_err(|error: GridError| error.into()).map(|()| pose)
    }
}

impl From<Se2> for Pose {
    fn from(parent_from_child: Se2) -> Self {
        let half = parent_from_child.theta() / 2.0;
        Self {
            position: Point { x: parent_from_child.x(), y: parent_from_child.y(), z: 0.0 },
            orientation: Quaternion { z: half.sin(), w: half.cos(), ..Quaternion::default() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{MessageError, Pose, Quaternion, Se2};

    #[test]
    fn a_pose_on_the_floor_comes_back_from_its_quaternion() {
        for theta in [-3.1, -1.0, 0.0, 0.3, 2.0, 3.1] {
            let pose = Se2::new(1.0, -2.0, theta);
            let error = Pose::from(pose).flat().unwrap().between(&pose).log();
            assert!(error.norm() < 1e-12, "{error:?}");
        }
    }

    #[test]
    fn a_quaternion_of_any_length_means_its_direction_and_none_at_all_no_turn() {
        let mut pose = Pose::from(Se2::new(0.0, 0.0, 1.2));
        pose.orientation.z *= 3.0;
        pose.orientation.w *= 3.0;
        assert!((pose.flat().unwrap().theta() - 1.2).abs() < 1e-12);
        pose.orientation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
        assert_eq!(pose.flat().unwrap().theta(), 0.0);
    }

    #[test]
    fn a_map_on_a_wall_and_a_pose_of_nan_are_errors() {
        let half = std::f64::consts::FRAC_PI_4;
        let mut pose = Pose::default();
        pose.orientation = Quaternion { x: half.sin(), w: half.cos(), ..pose.orientation };
        let Err(MessageError::Tilted { degrees }) = pose.flat() else { panic!("not refused") };
        assert!((degrees - 90.0).abs() < 1e-9);
        pose = Pose::default();
        pose.position.x = f64::NAN;
        assert!(pose.flat().is_err());
        pose = Pose::default();
        pose.orientation.w = f64::NAN;
        assert!(pose.flat().is_err());
    }
}
