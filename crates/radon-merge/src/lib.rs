//! Merges occupancy grid maps by wall segments of one shape, without tags and without a start.
//!
//! Edges of both maps are cut into segments; two that look alike propose a transform; the Radon
//! transform tunes its rotation and the similarity of the maps its translation; walls, cells and
//! entropy decide whether it is right. [`find_transform`] does all of it, and every block can be
//! called alone.
//!
//! ```
//! use ogm_core::Se2;
//! use ogm_sim::{FloorPlan, LidarParams, PairParams, simulate_pair};
//! use radon_merge::{RadonParams, find_transform};
//!
//! let lidar = LidarParams { beams: 257, scan_every: 0.48, ..LidarParams::sa() };
//! let world = PairParams { seed: 5, lidar, ..PairParams::sa() };
//! let pair = simulate_pair(&FloorPlan::random(5)?, &world)?;
//! let found = find_transform(&pair.target.map, &pair.source.map, &RadonParams::default(), &())?;
//! let target_from_source = found.outcome.found().expect("these maps match");
//! let error = target_from_source.between(&pair.target_from_source);
//! assert!(error.translation().norm() < 0.1 && error.theta().abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | block of the paper | here |
//! |---|---|
//! | edge detection, edge smoothing | [`detect_edges`], [`smooth_edges`] |
//! | segmentation, segment verification | [`distinctive_segments`], [`signature`], [`is_distinctive`] |
//! | cross correlation, approximate pose | [`correlate`], [`approximate_pose`] |
//! | Radon transform | [`radon`], [`tune_by_peaks`], [`RotationCorrelation`] |
//! | similarity index | [`tune_translation`] |
//! | exact pose verification | [`verify`], [`entropy`] |
//!
//! From Saeedi, Paull, Trentini, Li: *Multiple robot simultaneous localization and mapping*
//! (IROS 2011), its misprints corrected.

mod approximate;
mod correlation;
mod counts;
mod distinctive;
mod edges;
mod entropy;
mod error;
mod hypotheses;
mod parallel;
mod params;
mod pose_scorer;
mod radon;
mod rotation;
mod search;
mod signature;
mod similarity;
mod smoothing;
mod tracing;
mod verify;

pub use approximate::{PoseRule, approximate_pose};
pub use correlation::{Correlation, correlate};
pub use counts::JointCounts;
pub use distinctive::{DistinctiveParams, is_distinctive};
pub use edges::{EdgeParams, detect_edges};
pub use entropy::{EntropyHistogram, entropy, joint_entropy};
pub use error::RadonError;
pub use hypotheses::{Hypothesis, HypothesisParams};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::RadonParams;
pub use radon::{RadonImage, radon};
pub use rotation::{RotationCorrelation, RotationParams, tune_by_peaks};
pub use search::{Candidate, MapStages, RadonMatch, find_transform};
pub use signature::{Signature, signature};
pub use similarity::{
    Disagreement, Objective, TranslationParams, TranslationWindow, similarity, tune_translation,
};
pub use smoothing::smooth_edges;
pub use tracing::{SegmentParams, WallSegment, distinctive_segments};
pub use verify::{Verification, VerificationParams, WallShare, verification_index, verify};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
