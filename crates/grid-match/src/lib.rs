//! Finds the rigid transform between two occupancy grid maps, from nothing but the maps.
//!
//! [`match_maps`] needs no start pose and no tags. It ranks every pose that fits, with probability and
//! covariance, and believes the best if that reaches [`MatchParams::accept`]; otherwise it says what
//! is missing. [`PreparedMap`] keeps what is computed of one map.
//!
//! ```
//! use grid_match::{MatchParams, match_maps};
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//!
//! // A flat of 9 × 5 m, 0.25 m a cell, drawn twice in frames of different origin.
//! let picture = "
//!     ?####################################
//!     ?#...........#......................#
//!     ?#...........#.....###..............#
//!     ?#...........#.....###..............#
//!     ?#...........#......................#
//!     ?#......................#######.....#
//!     ?#..................................#
//!     ?#...........#......................#
//!     ?#...........#......................#
//!     ?#...........#......................#
//!     ?#######..##########..###############
//!     ?#........................#.........#
//!     ?#........................#.........#
//!     ?#......#####.............#.........#
//!     ?#......#####.......................#
//!     ?#......#####.......................#
//!     ?#........................#.........#
//!     ?#####....................#.........#
//!     ?#...#....................#.........#
//!     ?####################################";
//! let map = |x| OccupancyGrid::from_ascii(GridFrame::new(0.25, Se2::new(x, 0.0, 0.0))?, picture);
//!
//! let report = match_maps(&map(0.0)?, &map(40.0)?, &MatchParams::default(), &())?;
//! let target_from_source = report.outcome.found().expect("one flat");
//! assert!((target_from_source.x() + 40.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Hough spectra suggest rotations; at each and its half turn a Fourier transform scores every
//! translation; the best follow the distance fields of both maps, and go where parts that let go
//! lead; what is left is scored in metres of wall. Order, origins and threads do not matter.

mod bend;
mod bounds;
mod composite;
mod confidence;
mod correlate;
mod correlation_planes;
mod covariance;
mod crop;
mod error;
mod evaluate;
mod evidence;
mod lattice;
mod matching;
mod mode;
mod parallel;
mod params;
mod patches;
mod prepare;
mod refine;
mod relax;
mod report;
mod rotation;
mod score;
mod search;
mod settle;
mod sides;
mod signature;
mod smooth;
mod spectrum;
mod state;
mod surface;
mod surroundings;
mod terms;
mod translation;
mod visible;
mod wall_counts;
mod wall_distance;
mod wall_points;
mod weights;
mod work;

pub use composite::{pose_probabilities, refine_pose};
pub use error::MatchError;
pub use evidence::{Evidence, Relaxed, WallFit};
pub use matching::{match_maps, match_prepared, score_pose};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{Effort, MatchParams, Prior};
pub use prepare::PreparedMap;
pub use report::{Bend, Hypothesis, MatchReport, PatchMotion, WeakDirection};
pub use signature::{MapSignature, View, candidate_pairs};
pub use terms::{TERM_NAMES, TERMS, Weights};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
