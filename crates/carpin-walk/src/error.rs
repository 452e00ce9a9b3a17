//! What cannot be meant as a search.

use ogm_core::{Cancelled, GridError, ParameterError};

/// Maps, a start or parameters that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WalkError {
    /// Maps of different resolution, or a transform that is not finite.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A start that the search would not accept as a sample.
    #[error(
        "the start ({x:.1}, {y:.1}) cells, {turn:.1}° lies outside the search box of ±({reach_x:.1}, {reach_y:.1}) cells, ±{reach_turn:.1}° around its centre; widen the box or centre it on the start"
    )]
    StartOutside {
        /// From the centre of the box, cells.
        x: f64,
        /// From the centre of the box, cells.
        y: f64,
        /// From the centre of the box, degrees.
        turn: f64,
        /// Half the width of the box, cells.
        reach_x: f64,
        /// Half the height of the box, cells.
        reach_y: f64,
        /// Half the range of turns, degrees.
        reach_turn: f64,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}
