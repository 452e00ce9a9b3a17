//! Poses as people and reports write them: metres and degrees.

use ogm_core::Se2;

/// A pose or transform in metres and degrees; the form in JSON.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseDegrees {
    /// Along x, metres.
    pub x_m: f64,
    /// Along y, metres.
    pub y_m: f64,
    /// Counter-clockwise, degrees in [−180, 180).
    pub theta_deg: f64,
}

impl From<Se2> for PoseDegrees {
    fn from(a_from_b: Se2) -> Self {
        // Adding zero turns -0.0 into 0.0.
        Self {
            x_m: a_from_b.x() + 0.0,
            y_m: a_from_b.y() + 0.0,
            theta_deg: a_from_b.theta().to_degrees() + 0.0,
        }
    }
}

impl From<PoseDegrees> for Se2 {
    fn from(pose: PoseDegrees) -> Self {
        Self::new(pose.x_m, pose.y_m, pose.theta_deg.to_radians())
    }
}
