//! Maps as ROS 2 sends and records them: messages, and the bytes they are on the wire.

mod basic;
mod cdr;
mod error;
mod grid;
mod pose;
mod transform;

pub use basic::{Header, Point, Pose, Quaternion, Time};
pub use cdr::{from_cdr, to_cdr};
pub use error::MessageError;
pub use grid::{MapMetaData, OccupancyGridMessage};
pub use transform::{TfMessage, TransformStamped};
