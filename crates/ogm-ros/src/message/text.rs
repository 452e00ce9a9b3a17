//! A line of text.

use serde::{Deserialize, Serialize};

/// `std_msgs/msg/String`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Text {
    /// The line.
    pub data: String,
}

impl Text {
    /// How ROS 2 names the type.
    pub const TYPE: &'static str = "std_msgs/msg/String";
}
