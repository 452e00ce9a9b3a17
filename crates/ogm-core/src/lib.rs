//! The words that 2D occupancy grid tools share: grids, frames, poses, and what goes wrong.
//!
//! A [`OccupancyGrid`] is cells plus a [`GridFrame`], which says where they lie: the resolution in
//! metres a cell and the pose of the lower-left corner of cell (0, 0), y up, as in ROS. A [`Se2`]
//! maps points from one frame into another and its name says both, `target_from_source`. All
//! lengths are metres and all angles radians; cells are counted only inside a grid.
//!
//! ```
//! use nalgebra::Point2;
//! use ogm_core::{CellIndex, GridFrame, OccupancyGrid, Se2};
//!
//! let frame = GridFrame::new(0.05, Se2::new(-1.0, -1.0, 0.0))?;
//! let map = OccupancyGrid::from_ascii(frame, "###\n#.#\n#?#")?;
//! assert_eq!(map.cell_at(Point2::new(-0.93, -0.93)), Some(CellIndex { column: 1, row: 1 }));
//!
//! let target_from_source = Se2::new(3.0, 0.0, std::f64::consts::FRAC_PI_2);
//! let p_target = target_from_source * Point2::new(1.0, 0.0);
//! assert!((p_target - Point2::new(3.0, 1.0)).norm() < 1e-12);
//! # Ok::<(), ogm_core::GridError>(())
//! ```
//!
//! What is in here is needed by at least two of the crates above it and has no knobs: types,
//! invariants, and the grid kernels without parameters ([`l1_distance`], [`NearestCells`],
//! [`warp_nearest`]).

mod angle;
mod ascii;
mod distance;
mod error;
mod frame;
mod grid;
mod length;
mod nearest;
mod nearest_wall;
mod occupancy;
mod occupancy_grid;
mod outcome;
mod parameter;
mod progress;
mod refusal;
mod relative_pose;
mod robot;
mod se2;
mod segment;
mod tag;
mod tag_id;
mod warp;

pub use angle::{KFoldMean, mean_k_fold, undirected_difference, wrap_angle, wrap_period};
pub use distance::{l1_distance, l1_spread};
pub use error::GridError;
pub use frame::GridFrame;
pub use grid::{CellIndex, Grid, MAX_CELLS, cell_count};
pub use length::Length;
pub use nearest::{NearestCells, l2_distance_sq};
pub use nearest_wall::NearestWall;
pub use occupancy::{
    CellClass, ClassThresholds, LOG_ODDS_LIMIT, Occupancy, log_odds, probability_from_log_odds,
};
pub use occupancy_grid::OccupancyGrid;
pub use outcome::Outcome;
pub use parameter::{ParameterError, require};
pub use progress::{Cancelled, Progress, Stage, Steps};
pub use refusal::Refusal;
pub use relative_pose::RelativePose;
pub use robot::RobotId;
pub use se2::Se2;
pub use segment::Segment;
pub use tag::{TagEstimate, TagReading};
pub use tag_id::{TagId, TagIdError};
pub use warp::{CellsOnLine, NearestWarp, warp_nearest};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
