//! The pose of a differential-drive robot from encoders, scan matches and a gyroscope.
//!
//! The cascaded extended Kalman filter of Saeedi, Paull, Trentini, Li, *Multiple robot simultaneous
//! localization and mapping* (2011), section III: [`Ekf`] predicts by encoders and corrects by
//! laser and IMU one after the other. The paper prints neither equations nor noise; both are ours.

mod error;
mod filter;
mod params;
mod reading;

pub use error::EkfError;
pub use filter::Ekf;
/// The poses that the functions here take and give.
pub use ogm_core;
pub use params::EkfParams;
pub use reading::{Estimate, Reading, Verdict};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
