//! What goes in and what comes out.

use nalgebra::Matrix3;
use ogm_core::{RelativePose, Se2};

/// What a sensor says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading {
    /// Travel of both wheels since the last odometry, metres, forward positive.
    Odometry {
        /// Of the left wheel.
        left_m: f64,
        /// Of the right wheel.
        right_m: f64,
    },
    /// The motion between the last scan (of the start, for the first) and the one of now, in the
    /// robot's frame at either: target is the robot at the last scan, source the robot now. It is
    /// held against the odometry up to now, which must come first. Its probability is not used.
    ScanMatch(RelativePose),
    /// A scan that could not be matched with the last one: the next match counts from here.
    UnmatchedScan,
    /// Mean yaw rate since the last one (or the start), counter-clockwise.
    Imu {
        /// Radians a second.
        yaw_rate: f64,
    },
}

/// What became of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Nothing to correct by: odometry moved the estimate, or a scan was not matched.
    Predicted,
    /// The reading corrected the estimate.
    Used {
        /// Squared Mahalanobis distance of the innovation.
        distance_sq: f64,
    },
    /// The reading was too far from what was expected and left out.
    Gated {
        /// Squared Mahalanobis distance of the innovation.
        distance_sq: f64,
    },
}

/// Where the robot is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Time of the last reading, seconds.
    pub time: f64,
    /// Maps points of the robot's frame (x forward, y left) into the map's.
    pub map_from_robot: Se2,
    /// Covariance of (x, y, θ) along the map's axes, metres and radians.
    pub covariance: Matrix3<f64>,
}
