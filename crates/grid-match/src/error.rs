//! What cannot be meant as a matching problem.

use ogm_core::{Cancelled, GridError, ParameterError};

/// Parameters that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MatchError {
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A pose with a NaN or infinite part.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The search was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
