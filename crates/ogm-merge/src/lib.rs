//! Merges the occupancy grid maps of robot teams.
//!
//! [`align_pair`] finds the transform between two maps by any [`Method`], says what every stage
//! saw, or refuses with a reason; [`fuse`] makes one map of what hangs together. Every front end
//! calls these and decides nothing itself. [`known_poses`] stands for the search where the poses are
//! known.
//!
//! ```
//! use ogm_merge::{AlignParams, FusionParams, Method, RobotMap, align_pair, fuse};
//! use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, simulate_pair};
//!
//! let sparse = LidarParams { beams: 181, ..LidarParams::rf() };
//! let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
//! let world = PairParams { seed: 1, lidar: sparse, mapping, ..PairParams::default() };
//! let pair = simulate_pair(&FloorPlan::plan_a(), &world)?;
//!
//! let maps = [&pair.target.map, &pair.source.map];
//! let [target, source] = maps.map(RobotMap::from);
//! let report = align_pair(Method::Auto, &target, &source, &AlignParams::default(), &())?;
//! let target_from_source = report.outcome.clone().found().expect("these maps match");
//! let error = target_from_source.between(&pair.target_from_source);
//! assert!(error.translation().norm() < 0.02 && error.theta().abs() < 0.005);
//!
//! let [component] = &report.components()[..] else { panic!("they hang together") };
//! let merged = fuse(&maps, component, &FusionParams::default(), &())?;
//! assert!(merged.compared > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`merge_team`] takes any number of maps, [`MergeSession`] maps that grow, [`unbend`] bent ones.
//!
//! The papers' methods by themselves, with the evidence of every stage: [`align_by_tags`] (#1 to #3
//! of Tsardoulias, Thallas, Petrou, *Metric Map Merging using RFID Tags & Topological Information*),
//! [`align_carpin`] (Carpin and Birk), [`align_by_radon`] and [`merge_by_radon`] (Saeedi et al.).
//!
//! What may take long has an [`ogm_core::Progress`] for its last argument, `&()` for none.

mod bend;
mod checks;
mod error;
mod evidence;
#[cfg(feature = "serde")]
mod json;
mod known;
mod memory;
mod merge;
mod method;
mod pair;
mod parallel;
mod params;
mod pose;
mod recipes;
mod refine;
mod report;
mod resolution;
mod robot_map;
mod schedule;
mod segments;
mod session;
mod stop;
mod straighten;
mod tagged;
mod task;
mod team;
mod verify;
mod walk;
mod warning;

pub use bend::{BendParams, BendReport, BentComponent, BentMap, unbend, unbend_component};
pub use carpin_walk::Objective as WalkObjective;
pub use error::MergeError;
pub use evidence::{TagEvidence, WallAgreement, WallDirection};
pub use grid_match::{MapSignature, MatchParams, PreparedMap, Prior, View, candidate_pairs};
pub use grid_merge::{ConflictRegion, FusionParams, FusionRule, Merged, PlacedMap};
pub use known::{KnownPair, KnownPoses, known_poses};
pub use map_warp::{Warp, WarpParams};
pub use memory::{MOST_BENT_CELLS, aligning_bytes, bending_bytes, fusing_bytes};
pub use merge::{Component, Member, fuse, placed};
pub use method::{Method, TagMethod};
pub use ogm_core;
pub use pair::{align_pair, align_prepared};
pub use params::{AlignParams, Anchor, RfidParams};
pub use pose::PoseDegrees;
pub use report::{Hypothesis, PairReport, Stages, Verdict};
pub use rfid_loc::{FilterParams, localise};
pub use robot_map::RobotMap;
pub use segments::{TeamMerge, align_by_radon, merge_by_radon};
pub use session::{
    Because, Change, ChangeKind, MergeSession, Placement, ResumeError, RobotPrior, RobotState,
    SavedSession, SessionParams,
};
pub use straighten::{Straightening, straighten};
pub use tagged::{TagReport, align_by_tags};
pub use team::{Join, KnownPose, PairAlignment, TeamPair, TeamParams, TeamReport, merge_team};
pub use walk::{CarpinParams, CarpinReport, align_carpin};
pub use warning::Warning;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
