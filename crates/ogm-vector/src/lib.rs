//! The direction of a rectangular building, from the segments of its walls.
//!
//! Two maps of one building differ in rotation by the difference of their wall directions, up to
//! quarter turns: walls at right angles look the same from four sides. The idea, the grouping and
//! the weights are those of Tsardoulias, Thallas and Petrou, *Metric Map Merging using RFID Tags &
//! Topological Information*, section 4.1.2.
//!
//! ```
//! use nalgebra::Point2;
//! use ogm_core::Segment;
//! use ogm_vector::{Params, ogm_vector, wall_rotation};
//!
//! let wall = |direction: f64, length: f64| Segment {
//!     start: Point2::origin(),
//!     end: Point2::new(length * direction.cos(), length * direction.sin()),
//!     direction,
//!     reliability: 0.9,
//!     support: 100,
//! };
//! let here = ogm_vector(&[wall(0.0, 5.0), wall(-1.57, 3.0)], &Params::default()).found().unwrap();
//! let there = ogm_vector(&[wall(0.3, 5.0), wall(-1.27, 3.0)], &Params::default()).found().unwrap();
//! assert!((wall_rotation(&here, &there) + 0.3).abs() < 1e-9);
//! ```
//!
//! The paper's vector is the bisector of two perpendicular walls, which depends on where the
//! counting starts; the same segments give angles a quarter turn apart. [`OgmVector::direction`] is
//! the direction of the walls modulo a quarter turn instead, and [`OgmVector::theta_ogm`] the
//! bisector that belongs to it: −45° for a building along the axes, the paper's value.

mod group;
mod histogram;
mod params;
mod vector;

pub use group::{Group, Member};
pub use histogram::angle_histogram;
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{Estimator, GroupRule, Params, SecondGroup, Weights};
pub use vector::{OgmVector, ogm_vector, wall_rotation};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
