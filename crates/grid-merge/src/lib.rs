//! Fuses occupancy grids that lie in known poses: mapping, evidence fusion, gap treatment, coverage.
//!
//! [`merge`] takes maps with their poses in one reference frame and gives one map in that frame:
//! each output cell looks up its place in every map (no gaps), and what the maps say is summed as
//! log-odds and rounded once. Unknown is neutral. Where one map says wall and another says free,
//! the cell is a conflict, counted and shown.
//!
//! ```
//! use grid_merge::{FusionParams, PlacedMap, merge};
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//!
//! let frame = GridFrame::new(0.05, Se2::new(-1.0, 2.0, 0.0))?;
//! let left = OccupancyGrid::from_ascii(frame, "###\n#..\n###")?;
//! let right = OccupancyGrid::from_ascii(frame, "####\n...#\n####")?;
//! let placed = [
//!     PlacedMap { map: &left, reference_from_map: Se2::identity() },
//!     PlacedMap { map: &right, reference_from_map: Se2::new(0.10, 0.0, 0.0) },
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
mod lattice;
mod mapping;
mod merge;
mod params;
mod verdict;

pub use coarsen::coarsen;
pub use coverage::{PlacedCoverage, merge_coverage};
pub use error::FusionError;
pub use merge::{Merged, PlacedMap, merge, transform_grid};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{ForwardRounding, FusionParams, FusionRule, GapTreatment, Interpolation, Mapping};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
