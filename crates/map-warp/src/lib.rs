//! Straightens a bent map: motions of its patches give a smooth deformation without folds, its
//! uncertainty, and the grid through it.
//!
//! [`Warp::fit`] takes [`Motion`]s, what a matcher says about patches the size of a room, and gives
//! a [`Warp`]; [`warp_grid`] moves an occupancy grid through it.
//!
//! ```
//! use map_warp::{Motion, Warp, WarpParams};
//! use nalgebra::{Matrix3, Point2, Vector2, Vector3};
//!
//! // A corridor whose far end drifted to the left.
//! let variances = Vector3::new(4e-4, 4e-4, 1e-4);
//! let motions: Vec<Motion> = (0..6)
//!     .map(|i| 4.0 * f64::from(i))
//!     .map(|x| Motion {
//!         at: Point2::new(x, 0.0),
//!         shift: Vector2::new(0.0, -0.001 * x * x),
//!         turn: -0.002 * x,
//!         covariance: Matrix3::from_diagonal(&variances),
//!     })
//!     .collect();
//! let warp = Warp::fit(&motions, &WarpParams::default())?;
//! let end = warp.apply(Point2::new(18.0, 0.0));
//! assert!((end.y + 0.324).abs() < 0.03, "{end}");
//! assert!((warp.inverse(end) - Point2::new(18.0, 0.0)).norm() < 1e-9);
//! assert!(warp.jacobian(end).determinant() > 0.0 && warp.sigma(end) < 0.1);
//! # Ok::<(), map_warp::WarpError>(())
//! ```
//!
//! # Method
//!
//! The motion of the whole map is the robust rigid one. The displacement that is left is a Gaussian
//! process with a smooth isotropic kernel, conditioned on the shifts and turns of the patches
//! (Rasmussen, Williams: *Gaussian Processes for Machine Learning*, 2006, Eqs. 2.25, 2.26 and 9.1);
//! its mean is the smoothest displacement in the sense of the motion coherence of Myronenko and Song
//! (*Point Set Registration: Coherent Point Drift*, 2010). Embedded deformation (Sumner, Schmid,
//! Pauly 2007) and B-spline free forms (Rueckert and others 1999) give no uncertainty by themselves,
//! fold without a further term, and the latter's lattice has axes of its own; on simulated drift it
//! errs by 5.7 cm where this errs by 4.6 (`tests/against_a_lattice.rs`). Here the uncertainty is
//! the posterior's, a frame that is turned turns the result, and the norm of the displacement in the
//! kernel's Hilbert space bounds its slope everywhere: below 1, p ↦ p + d(p) is one to one by
//! Banach's fixed point. Where a fit would be steeper, the best of those that are not is taken.

mod error;
mod grid;
mod kernel;
mod lies;
mod motion;
mod params;
mod rigid;
mod system;
mod warp;

pub use error::WarpError;
pub use grid::warp_grid;
pub use motion::Motion;
/// The grids, frames and motions that the functions here take and give.
pub use ogm_core;
pub use params::WarpParams;
pub use warp::Warp;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
