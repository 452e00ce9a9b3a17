//! A changed rectangle of a map.

use ogm_io::ros::Header;
use serde::{Deserialize, Serialize};

/// `map_msgs/msg/OccupancyGridUpdate`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct OccupancyGridUpdate {
    /// When, and in which frame.
    pub header: Header,
    /// Column of its left edge in the map.
    pub x: i32,
    /// Row of its lower edge.
    pub y: i32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// As in [`OccupancyGridMessage`](ogm_io::ros::OccupancyGridMessage).
    #[serde(with = "serde_bytes")]
    pub data: Vec<u8>,
}

impl OccupancyGridUpdate {
    /// How ROS 2 names the type.
    pub const TYPE: &'static str = "map_msgs/msg/OccupancyGridUpdate";
}
