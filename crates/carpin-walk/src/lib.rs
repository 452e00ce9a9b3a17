//! Merges two occupancy grid maps by a Gaussian random walk over the transforms between them.
//!
//! [`align`] follows Carpin and Birk, *Stochastic map merging in rescue environments*: from a start,
//! it tries transforms near the current one, keeps those under which the maps look more alike and
//! sometimes one under which they do not, and returns the best it came by. How alike two maps look
//! is their picture distance [`psi`]: how far, on average, an obstacle of one is from an obstacle
//! of the other, and likewise for free cells.
//!
//! ```
//! use carpin_walk::{Params, RandomWalk, align};
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//!
//! let room = "#########\n#.......#\n#.......#\n#...#####\n#...#????\n#####????";
//! let frame = GridFrame::new(0.1, Se2::new(3.0, -1.0, 0.2))?;
//! let map = OccupancyGrid::from_ascii(frame, room)?;
//!
//! let start = Se2::new(0.1, -0.2, 0.02);
//! let found = align(&map, &map, start, &RandomWalk::default(), &Params::default(), &())?;
//! let found = found.found().expect("there is a room");
//! assert!(found.psi < 0.1 * found.start_psi);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The walk itself, [`random_walk`], takes any function of a placement. Its acceptance function,
//! mean and covariance are [`Rules`]; hill climbing and simulated annealing are two more sets of
//! them. With the feature `rayon`, walks from one start run on all cores, with the same result.

mod align;
mod belief;
mod class_map;
mod distance;
mod error;
mod layer;
mod params;
mod random_walk;
mod raster;
mod rules;
mod space;
mod special_cases;
mod walk;

pub use align::{Alignment, align};
pub use belief::{belief, occupancy};
pub use distance::{Dissimilarity, MapDistance, psi};
pub use error::WalkError;
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{Around, DistanceParams, Objective, Params};
pub use random_walk::{Acceptance, Drift, RandomWalk, Spread, TurnUnit};
pub use rules::{Rules, WalkState};
pub use space::{Placement, SearchBox};
pub use special_cases::{Annealing, HillClimbing};
pub use walk::{Budget, End, Sample, Walk, random_walk};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
