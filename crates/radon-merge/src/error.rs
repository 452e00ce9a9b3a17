//! What cannot be meant as a pair of maps to merge.

use ogm_core::{Cancelled, GridError, ParameterError};

/// Maps, points or parameters that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RadonError {
    /// Maps of different resolution, or a transform that is not finite or leads too far.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A point with a NaN or infinite part.
    #[error("point {index} is at ({x}, {y}); coordinates must be finite")]
    NonFinitePoint {
        /// Which point.
        index: usize,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
    },
    /// Radon images that were not sampled at the same angles.
    #[error("Radon images of {target} and of {source_} angles cannot be compared; use one step")]
    DifferentAngles {
        /// Angles of the target's image.
        target: usize,
        /// Angles of the source's image.
        source_: usize,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}
