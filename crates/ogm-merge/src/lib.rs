//! Merges the occupancy grid maps of robot teams.
//!
//! The recipes, each a short function over small crates:
//!
//! - [`align`] and [`merge`]: methods #1 to #3 of Tsardoulias, Thallas, Petrou, *Metric Map Merging
//!   using RFID Tags & Topological Information* ([`Method`]). A [`MergeReport`] says what each
//!   stage saw.
//! - [`align_carpin`]: the random walk of Carpin and Birk, from a rough start.
//! - [`align_by_radon`] and [`merge_by_radon`]: the segments of Saeedi et al., for a team.
//! - [`merge_matched`]: any two maps, without tags or a start.
//!
//! ```
//! use ogm_merge::{MergeParams, Method, RobotMap, merge};
//! use ogm_sim::{FloorPlan, LidarParams, PairParams, simulate_pair};
//! use rfid_loc::{FilterParams, localise};
//!
//! let sparse = LidarParams { beams: 181, ..LidarParams::rf() };
//! let world = PairParams { seed: 1, lidar: sparse, ..PairParams::default() };
//! let pair = simulate_pair(&FloorPlan::plan_a(), &world)?;
//! let target_tags = localise(&pair.target.readings, &FilterParams::default(), &())?;
//! let source_tags = localise(&pair.source.readings, &FilterParams::default(), &())?;
//!
//! let target = RobotMap { map: &pair.target.map, tags: &target_tags };
//! let source = RobotMap { map: &pair.source.map, tags: &source_tags };
//! let (report, merged) = merge(Method::Rfid3, &target, &source, &MergeParams::default())?;
//! let target_from_source = report.outcome.found().expect("these maps match");
//! let error = target_from_source.between(&pair.target_from_source);
//! assert!(error.translation().norm() < 0.02 && error.theta().abs() < 0.005);
//! assert!(merged.expect("merged where a transform was found").compared > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod align;
mod carpin;
mod error;
mod matched;
mod params;
mod radon;
mod recipes;
mod report;
mod stop;
mod verify;

pub use align::{Method, RobotMap, align, merge};
pub use carpin::{CarpinParams, CarpinReport, align_carpin};
pub use error::MergeError;
pub use matched::merge_matched;
pub use params::{Anchor, MergeParams, RfidParams};
pub use radon::{TeamMerge, align_by_radon, merge_by_radon};
pub use report::{Evidence, MergeReport, WallAgreement, WallDirection, Warning};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
