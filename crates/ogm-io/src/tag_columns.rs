//! The columns of a tag log.

/// The first line of a tag log: identifier, robot position in its map frame, range, in metres.
pub const TAG_LOG_HEADER: &str = "tag_id,robot_x_m,robot_y_m,range_m";
