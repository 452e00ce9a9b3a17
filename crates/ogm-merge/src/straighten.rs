//! A map turned along the walls of its building.

use ogm_core::{OccupancyGrid, Outcome, Se2};

use crate::recipes::wall_direction;
use crate::{RfidParams, WallDirection};

/// How a map is to be turned, and why.
#[derive(Debug, Clone)]
pub struct Straightening {
    /// Maps points of the map into the same map turned about the origin of its frame, by at most an
    /// eighth of a turn, so that its walls lie along the axes.
    pub straight_from_map: Se2,
    /// The walls and their direction.
    pub walls: WallDirection,
}

/// The turn that lays the walls of `map` along the axes (the direction of Tsardoulias et al.,
/// section 4.1.2), or that it has no straight walls.
pub fn straighten(map: &OccupancyGrid, params: &RfidParams) -> Outcome<Straightening> {
    match wall_direction(map, params) {
        Ok(walls) => Outcome::Found(Straightening {
            straight_from_map: Se2::new(0.0, 0.0, -walls.vector.direction),
            walls,
        }),
        Err(refusal) => Outcome::Refused(refusal),
    }
}
