//! What a call changed for those who follow a session.

use ogm_core::Se2;

/// What became of a robot's map.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Whose map.
    pub robot: String,
    /// What happened to it.
    pub kind: ChangeKind,
}

/// What may happen to a map in a session.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ChangeKind {
    /// It has a place in the world, which it had not.
    Placed {
        /// Maps its points into the world.
        world_from_map: Se2,
        /// Probability that it lies there.
        probability: f64,
    },
    /// It lies elsewhere than it was said to: another answer, not the same one more exactly.
    Moved {
        /// Where it was said to lie.
        old_world_from_map: Se2,
        /// Where it lies.
        world_from_map: Se2,
        /// Probability of that.
        probability: f64,
    },
    /// It has no place in the world any more.
    Undone {
        /// Where it was said to lie.
        old_world_from_map: Se2,
        /// Why not.
        because: Because,
    },
    /// Its walls are not where they were in its own frame: it started anew. Its old map counts for
    /// nothing; its place is carried over where the new map shows the old one's walls.
    NewFrame,
}

/// Why a map lost its place.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Because {
    /// Its walls, or those of the maps it hung by, contradict it.
    Contradicted {
        /// Metres of wall in what another map of the world calls free.
        conflict_m: f64,
        /// Metres of wall on wall of that map.
        hit_m: f64,
    },
    /// All that the walls say together is better explained without it there.
    Outweighed {
        /// By how much, log-odds.
        lead: f64,
    },
    /// Somebody asked for it.
    Asked,
    /// It started anew in another frame.
    NewFrame,
}
