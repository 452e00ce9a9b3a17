//! A small world to measure map merging in: floor plans, exploring robots, lidar, radio tags, and
//! the exact truth.
//!
//! Two robots drive through a [`FloorPlan`]. Each maps what its lidar sees into an occupancy grid
//! in a frame of its own, at its start with a random heading, and reads ranges to radio tags on
//! the walls. [`simulate_pair`] returns both maps and the motion between their frames, which no
//! merging method is told; [`simulate_team`] sends any number of robots.
//!
//! ```
//! use ogm_core::ClassThresholds;
//! use ogm_sim::{FloorPlan, MappingParams, PairParams, simulate_pair};
//!
//! let plan = FloorPlan::plan_a();
//! let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
//! let pair = simulate_pair(&plan, &PairParams { seed: 1, mapping, ..PairParams::default() })?;
//!
//! let wall = pair.source.map.occupied_points(&ClassThresholds::default())[0];
//! let in_plan = pair.target.world_from_map * (pair.target_from_source * wall);
//! assert!(plan.distance_to_face(in_plan) < 0.1);
//! # Ok::<(), ogm_sim::SimError>(())
//! ```
//!
//! - Plans: [`FloorPlan::plan_a`], [`FloorPlan::plan_b`], [`FloorPlan::random`], or text for
//!   [`FloorPlan::parse`].
//! - One map: [`survey`] maps a plan along both paths in a frame of any heading;
//!   [`map_along_path`] sends one robot along any path.
//! - [`labelled_pair`]: two maps of floors of many kinds, overlapping or not, with the transform
//!   that is right, to measure and to calibrate a matcher.
//! - [`bent_pair`]: the same of floors that overlap, bent as asked for, with where every place of one
//!   lies in the other.
//! - [`labelled_team`]: the maps of a whole team, robots that never meet and a stranger among them.
//! - Sensor logs: [`record_sensors`] gives what encoders, gyroscope and laser of a
//!   differential-drive robot say along a path, and [`map_scans`] makes a map of placed scans.
//! - Real maps: [`drive`] finds a path through their free space and [`tag_readings`] reads
//!   simulated tags along it.
//!
//! Everything is decided by seeds: the same parameters give the same bytes.

mod bend;
mod conditions;
mod draft;
mod draw;
mod drive;
mod error;
mod explore;
mod floors;
mod labelled;
mod labelled_team;
mod lidar;
mod mapping;
mod navigate;
mod pair;
mod pair_bend;
mod params;
mod path;
mod pieces;
mod plan;
mod plan_text;
mod random_plan;
mod rounds;
mod run;
mod scans;
mod sensor_log;
mod shown;
mod style;
mod symmetry;
mod tags;
mod team;
mod truth;
mod wander;

pub use drive::{DriveParams, drive};
pub use error::SimError;
pub use floors::FloorKind;
pub use labelled::{LabelledPair, Relation, bent_pair, labelled_pair};
pub use labelled_team::{LabelledTeam, labelled_team};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use pair::{SimulatedPair, simulate_pair};
pub use pair_bend::PairBend;
pub use params::{DriftParams, LidarParams, MappingParams, PairParams, TagParams};
pub use plan::{Face, FloorPlan, SOURCE, TARGET};
pub use run::{RobotRun, map_along_path, survey};
pub use scans::map_scans;
pub use sensor_log::{SensorLog, SensorParams, SensorSample, record_sensors};
pub use style::MapStyle;
pub use tags::tag_readings;
pub use team::{SimulatedTeam, TeamMember, simulate_team};
pub use truth::PairTruth;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
