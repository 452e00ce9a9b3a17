//! The messages that other messages are made of, field by field as ROS 2 defines them.

use serde::{Deserialize, Serialize};

/// `builtin_interfaces/msg/Time`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
pub struct Time {
    /// Seconds since the epoch of whoever wrote it.
    pub sec: i32,
    /// And nanoseconds, below 10⁹.
    pub nanosec: u32,
}

impl Time {
    /// The time `nanoseconds` after the epoch; before it, and after 2038, the nearest there is.
    #[must_use]
    pub fn from_nanoseconds(nanoseconds: u64) -> Self {
        let sec = i32::try_from(nanoseconds / 1_000_000_000).unwrap_or(i32::MAX);
        let nanosec = u32::try_from(nanoseconds % 1_000_000_000).unwrap_or(0);
        Self { sec, nanosec }
    }

    /// Nanoseconds since the epoch; before it, 0.
    #[must_use]
    pub fn nanoseconds(self) -> u64 {
        u64::try_from(self.sec).map_or(0, |sec| sec * 1_000_000_000 + u64::from(self.nanosec))
    }
}

/// `std_msgs/msg/Header`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Header {
    /// When what follows was so.
    pub stamp: Time,
    /// The frame that it is in.
    pub frame_id: String,
}

/// `geometry_msgs/msg/Point` and `Vector3`, metres.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Point {
    /// Forward, or east.
    pub x: f64,
    /// Left, or north.
    pub y: f64,
    /// Up.
    pub z: f64,
}

/// `geometry_msgs/msg/Quaternion`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Quaternion {
    /// Of the axis of the turn, times the sine of half of it.
    pub x: f64,
    /// Likewise.
    pub y: f64,
    /// Likewise.
    pub z: f64,
    /// The cosine of half of the turn.
    pub w: f64,
}

impl Default for Quaternion {
    /// No turn.
    fn default() -> Self {
        Self { x: 0.0, y: 0.0, z: 0.0, w: 1.0 }
    }
}

/// `geometry_msgs/msg/Pose`; `Transform` has the same bytes.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Pose {
    /// Where, metres.
    pub position: Point,
    /// Which way round.
    pub orientation: Quaternion,
}
