//! What there is to publish.

use ogm_io::OCCUPANCY_GRID_DEFINITION;
use ogm_io::ros::{OccupancyGridMessage, TfMessage};

use crate::message::DiagnosticArray;

/// What a message is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// The merged map.
    Map,
    /// Where the robots' map frames lie in the world, of those that have a place.
    Transforms,
    /// Who is placed, how surely, and who is not and why.
    Status,
    /// Where the maps contradict each other, on the cells of the merged map: 100 is a conflict, 0 is
    /// none.
    Conflicts,
}

impl Output {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Map, Self::Transforms, Self::Status, Self::Conflicts];

    /// How ROS 2 names the type.
    #[must_use]
    pub fn kind(self) -> &'static str {
        match self {
            Self::Map | Self::Conflicts => OccupancyGridMessage::TYPE,
            Self::Transforms => TfMessage::TYPE,
            Self::Status => DiagnosticArray::TYPE,
        }
    }

    /// The definition of that type.
    #[must_use]
    pub fn definition(self) -> &'static str {
        match self {
            Self::Map | Self::Conflicts => OCCUPANCY_GRID_DEFINITION,
            Self::Transforms => TfMessage::DEFINITION,
            Self::Status => DiagnosticArray::DEFINITION,
        }
    }

    /// The topic, `merged_map` being that of the merged map.
    #[must_use]
    pub fn topic(self, merged_map: &str) -> &str {
        match self {
            Self::Map => merged_map,
            Self::Transforms => "/tf_static",
            Self::Status => "/ogm/status",
            Self::Conflicts => "/ogm/conflicts",
        }
    }
}

/// A message to publish, latched.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// What it is about.
    pub output: Output,
    /// Its bytes, header included.
    pub bytes: Vec<u8>,
}
