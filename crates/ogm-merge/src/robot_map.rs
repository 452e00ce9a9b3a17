//! What a robot hands in.

use ogm_core::{OccupancyGrid, TagEstimate};

/// A robot's map and the tags that it localised, in the same map frame.
#[derive(Debug, Clone, Copy)]
pub struct RobotMap<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The tags, as [`localise`](crate::localise) gives them; none for a robot without a reader.
    pub tags: &'a [TagEstimate],
}

impl<'a> From<&'a OccupancyGrid> for RobotMap<'a> {
    /// A map without tags.
    fn from(map: &'a OccupancyGrid) -> Self {
        Self { map, tags: &[] }
    }
}
