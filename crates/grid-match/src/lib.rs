//! Finds the rigid transform between two occupancy grid maps, from nothing but the maps.

mod bounds;
mod channels;
mod confidence;
mod correlate;
mod covariance;
mod error;
mod lattice;
mod matching;
mod params;
mod prepare;
mod refine;
mod report;
mod rotation;
mod score;
mod search;
mod smooth;
mod spectrum;
mod translation;
mod work;

pub use error::MatchError;
pub use matching::{match_maps, match_prepared, score_pose};
pub use params::{Effort, MatchParams, Prior};
pub use prepare::PreparedMap;
pub use report::{Hypothesis, MatchReport, WeakDirection};
pub use score::Evidence;
