//! ROS 2 bags: messages out of MCAP and SQLite files, and into MCAP.

mod chunks;
mod definition;
mod error;
mod folder;
mod map;
mod mcap;
mod message;
mod read;
mod reference;
mod sqlite;
mod write;

pub use self::definition::OCCUPANCY_GRID_DEFINITION;
pub use self::error::BagError;
pub use self::message::BagMessage;
pub use self::read::read_bag;
pub use self::reference::BagMap;
pub use self::write::{BagTopic, BagWriter, TopicId};

pub(crate) use self::map::read_message;
