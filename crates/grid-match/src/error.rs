//! What cannot be meant as a matching problem.

use ogm_core::Cancelled;

/// Parameters that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MatchError {
    /// A parameter outside its range.
    #[error("{name} must be {requirement}, got {value}")]
    InvalidParameter {
        /// Field of [`MatchParams`](crate::MatchParams).
        name: &'static str,
        /// What it must be.
        requirement: &'static str,
        /// What was given.
        value: f64,
    },
    /// A pose with a NaN or infinite part.
    #[error("a pose must be finite, got ({x}, {y}, {theta})")]
    NonFinitePose {
        /// Translation x, metres.
        x: f64,
        /// Translation y, metres.
        y: f64,
        /// Rotation, radians.
        theta: f64,
    },
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
