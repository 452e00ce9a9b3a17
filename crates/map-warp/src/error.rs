//! What cannot be made a deformation.

use ogm_core::{Cancelled, GridError, ParameterError};

/// Motions, parameters or grids that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WarpError {
    /// A place, shift, turn or covariance that is NaN or infinite.
    #[error("motion {motion} holds a number that is not finite")]
    NonFinite {
        /// Which motion, from 0.
        motion: usize,
    },
    /// A place or shift farther than any map reaches.
    #[error(
        "motion {motion} reaches {reach_m} m from the origin, at most {limit_m} m are accepted"
    )]
    TooFar {
        /// Which motion, from 0.
        motion: usize,
        /// Largest coordinate, metres.
        reach_m: f64,
        /// Largest that is accepted, metres.
        limit_m: f64,
    },
    /// A covariance that is not symmetric and positive semidefinite.
    #[error(
        "the covariance of motion {motion} must be symmetric without negative eigenvalues, its least is {least}"
    )]
    BadCovariance {
        /// Which motion, from 0.
        motion: usize,
        /// Its least eigenvalue; NaN where it is not symmetric.
        least: f64,
    },
    /// More motions than a dense system is solved for.
    #[error("{have} motions, at most {limit}: take larger patches")]
    TooManyMotions {
        /// Motions given.
        have: usize,
        /// Most that are accepted.
        limit: usize,
    },
    /// Motions whose system has no solution in double precision.
    #[error("the system of {motions} motions is singular to rounding: give larger covariances")]
    Singular {
        /// Motions in the system.
        motions: usize,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// An output that is no grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The caller said stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
