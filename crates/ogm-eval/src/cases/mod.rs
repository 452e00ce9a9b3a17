//! What is measured on: simulated worlds, and pairs of maps on disk.

pub(crate) mod estate;
pub(crate) mod map_pair;
pub(crate) mod rescue;
pub(crate) mod team_world;
pub(crate) mod worlds;
