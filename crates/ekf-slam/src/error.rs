//! What cannot be meant as a log of a robot.

use ogm_core::{GridError, ParameterError};

/// A reading, a start or parameters that cannot be meant; the filter stays as it was.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EkfError {
    /// A time that is NaN or infinite.
    #[error("the time of a reading is {time} s; drop readings without a time")]
    NonFiniteTime {
        /// What it is, seconds.
        time: f64,
    },
    /// A reading older than the last one.
    #[error("a reading of {time} s follows one of {last} s; sort the log by time")]
    TimeGoesBack {
        /// Time of the reading, seconds.
        time: f64,
        /// Time of the last one, seconds.
        last: f64,
    },
    /// Too long without a reading.
    #[error(
        "{gap} s without a reading, at most {limit} s are bridged; split the log there or raise max_gap_s"
    )]
    Gap {
        /// How long, seconds.
        gap: f64,
        /// Most that is bridged, seconds.
        limit: f64,
    },
    /// A yaw rate that covers no time.
    #[error("two yaw rates at {time} s; each must cover the time since the one before")]
    NoTimeForYawRate {
        /// When, seconds.
        time: f64,
    },
    /// A value of a reading that is NaN, infinite, or so large that the estimate would be.
    #[error("the reading of {time} s is not finite or leaves no finite pose; drop it")]
    NonFiniteReading {
        /// When, seconds.
        time: f64,
    },
    /// A covariance that is none.
    #[error("a covariance at {time} s is not symmetric and positive")]
    NotACovariance {
        /// When, seconds.
        time: f64,
    },
    /// A start with a NaN or infinite part.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}
