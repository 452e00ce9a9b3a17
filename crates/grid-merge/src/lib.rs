//! Fuses occupancy grids that lie in known poses: mapping, evidence fusion, gap treatment, coverage.
//!
//! [`merge`] takes maps with their poses in one reference frame and gives one map in that frame:
//! each output cell looks up its place in every map (no gaps), walls stay, and what the maps say is
//! summed as log-odds and rounded once. Unknown is neutral. A wall beside another map's wall is the
//! same wall, once, where the surer map has it; a wall where another map says free and has none as
//! near as the uncertainty of the poses allows is a conflict: it stays, and is counted and shown.
//!
//! ```
//! use grid_merge::{FusionParams, PlacedMap, merge};
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//!
//! let frame = GridFrame::new(0.05, Se2::new(-1.0, 2.0, 0.0))?;
//! let left = OccupancyGrid::from_ascii(frame, "###\n#..\n###")?;
//! let right = OccupancyGrid::from_ascii(frame, "####\n...#\n####")?;
//! let placed = [
//!     PlacedMap::new(&left, Se2::identity()),
//!     PlacedMap::new(&right, Se2::new(0.10, 0.0, 0.0)),
//! ];
//! let merged = merge(&placed, &FusionParams::default(), &())?;
//! assert_eq!(merged.map.to_ascii(), "######\n#....#\n######\n");
//! assert_eq!((merged.compared, merged.conflict_count), (3, 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The forward mapping of the literature, its gaps and their cures (Tsardoulias, Thallas, Petrou,
//! *Metric Map Merging using RFID Tags & Topological Information*, section 4.4) are
//! [`Mapping::Forward`] and [`GapTreatment`]. [`transform_grid`] moves one map, [`coarsen`] brings
//! one to a coarser resolution without losing thin walls.

mod bilinear;
mod coarsen;
mod coverage;
mod error;
mod evidence;
mod fuse;
mod gaps;
mod keep_walls;
mod lattice;
mod lay;
mod mapping;
mod mask;
mod merge;
mod params;
mod placed;
mod pose;
mod provenance;
mod quality;
mod regions;
mod rows;
mod verdict;
mod walls;

pub use coarsen::coarsen;
pub use coverage::{PlacedCoverage, merge_coverage};
pub use error::FusionError;
pub use mask::CellMask;
pub use merge::{Merged, merge, transform_grid};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{ForwardRounding, FusionParams, FusionRule, GapTreatment, Interpolation, Mapping};
pub use placed::PlacedMap;
pub use provenance::{Claim, Provenance, provenance};
pub use quality::{FusionQuality, InputQuality, fusion_quality};
pub use regions::ConflictRegion;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
