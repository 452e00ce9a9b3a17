//! Maps and tag logs on disk: ROS `map_server` YAML with PGM or PNG, tag readings as CSV.
//!
//! Cells are classified by the file's own thresholds, with the strict comparisons of `map_server`,
//! before they become [`ogm_core::Occupancy`]; image rows are flipped here and nowhere else, so
//! that row 0 of a map is its lowest. What is suspicious in a file but still has a meaning is a
//! [`MapWarning`]; what cannot be meant is an [`IoError`] that names file, key and value.
//!
//! ```
//! use ogm_io::{MapHeader, MapWarning, ReadOptions};
//!
//! let yaml = b"image: map.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n\
//!              occupied_thresh: 0.65\nfree_thresh: 0.25\n";
//! let (header, warnings) = MapHeader::parse(yaml)?;
//! assert!(warnings.is_empty());
//!
//! let (map, warnings) = header
//!     .read_image(b"P2 2 2 255  0 254  254 205".to_vec(), &ReadOptions::default())?;
//! assert_eq!(map.to_ascii(), "#.\n.?\n");
//! // 205 is unknown to whoever saved this, but below a free_thresh of 0.25.
//! assert!(matches!(warnings[..], [MapWarning::GreyReadAsUnknown { cells: 1, .. }]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`read_map`] and [`write_map`] do the same with files; a map is written atomically, and by
//! [`write_file`] so is what goes with it.

#![expect(clippy::disallowed_methods, reason = "files are what this crate is for")]

mod allocate;
#[cfg(feature = "bags")]
mod bag;
mod bounded;
mod classify;
mod codec;
mod decode;
mod entries;
mod error;
mod file;
mod format;
mod header;
mod hidden;
mod lfs;
mod lock;
mod map;
mod png;
mod pnm;
mod raster;
#[cfg(feature = "ros")]
pub mod ros;
mod size;
mod tag_columns;
mod tags;
mod target;
mod temporary;
mod text;
mod warning;
mod write;
mod yaml_file;

#[cfg(feature = "bags")]
pub use bag::{
    BagError, BagMap, BagMessage, BagTopic, BagWriter, OCCUPANCY_GRID_DEFINITION, TopicId, read_bag,
};
pub use classify::ReadOptions;
pub use error::{IoError, MapImageError, TagLogError, YamlError};
pub use file::write_file;
pub use header::{MapHeader, MapMode};
pub use map::{LoadedMap, MapFiles, read_map, read_map_with};
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use size::MapSize;
pub use tag_columns::TAG_LOG_HEADER;
pub use tags::{parse_tags, read_tags, write_tags};
pub use text::TextEncoding;
pub use warning::MapWarning;
pub use write::{CellEncoding, StagedMap, WriteOptions, recover_map, write_map};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
