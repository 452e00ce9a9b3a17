//! What cannot be merged.

use ogm_core::{Cancelled, GridError};

/// A merge that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FusionError {
    /// No map to take the output's lattice from.
    #[error("nothing to merge: at least one map is needed")]
    NoMaps,
    /// A pose with a NaN or infinite part.
    #[error("the pose of map {map}: {cause}")]
    NonFinitePose {
        /// Which map, from 0.
        map: usize,
        /// What is wrong with it.
        cause: GridError,
    },
    /// Forward mapping would scatter the cells of a map over a finer output.
    #[error(
        "map {map} has cells of {have} m, too coarse for forward mapping onto {output} m; use inverse mapping"
    )]
    TooCoarseToScatter {
        /// Which map, from 0.
        map: usize,
        /// Metres a cell of the map.
        have: f64,
        /// Metres a cell of the output.
        output: f64,
    },
    /// Coarsening to a finer resolution.
    #[error("cells of {have} m cannot be coarsened to {asked} m")]
    FinerThanSource {
        /// Metres a cell of the map.
        have: f64,
        /// Metres a cell that were asked for.
        asked: f64,
    },
    /// More ways in which the maps say occupied and free of a cell than are told apart.
    #[error("the maps differ in more than 65 536 ways; ask for the provenance of fewer maps")]
    TooManyClaims,
    /// An output that is no grid, by its size or its resolution.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The merge was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
