//! Rigid 2D alignment of wall points by ICP that pairs only walls seen from the same side.
//!
//! [`align`] refines a start that is good to a few decimetres; [`search_start`] looks further around
//! one that is not. [`align_points`] takes plain points, [`align_to`] a target whose index is kept.
//! A wall has two faces, and two robots may have seen one each; pairing them would shift a map by
//! the thickness of its walls. So every [`WallPoint`] carries the side on which it has free space,
//! and points pair only if these sides agree and each is nearest to the other.
//!
//! ```
//! use icp2d::{IcpParams, WallPoint, WallPoints, align};
//! use nalgebra::Point2;
//! use ogm_core::Se2;
//!
//! let corner = (0..100).flat_map(|i| {
//!     let along = f64::from(i) * 0.05;
//!     [Point2::new(along, 0.0), Point2::new(0.0, along)]
//! });
//! let points: Vec<_> =
//!     corner.map(|position| WallPoint { position, free_side: None }).collect();
//! let walls = WallPoints::from_points(points, 0.05)?;
//!
//! let start = Se2::new(0.02, -0.015, 0.002);
//! let found = align(&walls, &walls, start, &IcpParams::default())?.found().unwrap();
//! assert!(found.termination.is_converged());
//! assert!(found.target_from_source.translation().norm() < 1e-9);
//! # Ok::<(), icp2d::IcpError>(())
//! ```
//!
//! The step is that of Tsardoulias, Thallas, Petrou: *Metric map merging using RFID tags &
//! topological information*, section 4.3, which leaves reach, pairing and stop open; see
//! [`IcpParams`] for those chosen here. Nearest neighbours come from the bounding volume hierarchy
//! of `parry2d`, or from buckets where the points are as dense as cells on walls.

mod align;
mod buckets;
mod cloud;
mod convention;
mod error;
mod hierarchy;
mod nearest;
mod nearest_index;
mod outcome;
mod pairing;
mod params;
mod sided;
mod start;
mod step;
mod structure;
mod target;
mod tracking;
mod wall_points;

pub use align::{align, align_points, align_to};
pub use convention::translate_then_rotate;
pub use error::IcpError;
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use outcome::{Alignment, Correspondence, Section, Termination};
pub use params::{IcpParams, Kernel, Metric, Pairing};
pub use start::{StartParams, search_start};
pub use target::{Target, correspondences};
pub use wall_points::{WallPoint, WallPoints};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
