//! What cannot be meant as an alignment problem.

use ogm_core::{GridError, ParameterError};

/// Points, a start or parameters that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IcpError {
    /// A wall point that is not finite, or further from the origin than any map reaches.
    #[error("wall point {index} is at ({x}, {y}); coordinates must be finite and below {limit} m")]
    InvalidPoint {
        /// Which point of its set.
        index: usize,
        /// Its x, metres.
        x: f64,
        /// Its y, metres.
        y: f64,
        /// Largest magnitude of a coordinate, metres.
        limit: f64,
    },
    /// A free side that is not a direction.
    #[error("the free side of wall point {index} is ({x}, {y}); it must be a unit vector")]
    InvalidFreeSide {
        /// Which point of its set.
        index: usize,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
    },
    /// A spacing that is not a usable number.
    #[error("the spacing of wall points must be finite and above 0, got {spacing} m")]
    InvalidSpacing {
        /// Metres a cell.
        spacing: f64,
    },
    /// A start with a NaN or infinite part.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}
