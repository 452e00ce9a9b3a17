//! Straight walls of an occupancy grid, found by RANSAC.
//!
//! The method is that of Tsardoulias, Thallas and Petrou, *Metric Map Merging using RFID Tags &
//! Topological Information*, section 4.1.1: lines are voted for by a sample of the occupied cells,
//! broken where they jump from one obstacle to another, joined where several lie on one wall, and
//! kept if they are long and lie on occupied cells all along. What is left are few walls with
//! precise directions, not a complete drawing of the map.
//!
//! ```
//! use line_ransac::{Params, extract_segments};
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//!
//! let wall = "#".repeat(60);
//! let gap = ".".repeat(60);
//! let frame = GridFrame::new(0.05, Se2::new(0.0, 0.0, 0.3))?;
//! let map = OccupancyGrid::from_ascii(frame, &format!("{wall}\n{gap}\n{gap}\n{gap}\n{wall}"))?;
//!
//! let walls = extract_segments(&map, &Params::default()).found().unwrap();
//! assert!((walls.segments[0].direction - 0.3).abs() < 1e-9);
//! assert!((walls.segments[0].length() - 59.0 * 0.05).abs() < 1e-9);
//! # Ok::<(), ogm_core::GridError>(())
//! ```
//!
//! [`extract_lines`] does the same with a list of points and says which of them are on each line.
//!
//! Inside, points are cells; a threshold of [`Params`] is a [`Length`](ogm_core::Length) in metres
//! that does not fall below a few cells of the map at hand. The same map, parameters and seed give
//! the same bytes.

mod breakdown;
mod detect;
mod extract;
mod farthest;
mod join;
mod line;
mod lines;
mod params;
mod points;
mod pool;
mod reliability;
mod settle;
mod strip;

pub use extract::{Extraction, Stages, Statistics, extract_segments};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{BreakRule, DirectionRule, Params};
pub use points::{PointLine, extract_lines};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
