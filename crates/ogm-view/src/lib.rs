//! Occupancy grid maps as pictures.
//!
//! [`occupancy`] shows one map in greys, [`overlay`] two maps on each other and [`overlay_all`] any
//! number, [`overlay_sheet`] these with legend, scale bar and frame axes, [`marked`] and
//! [`provenance`] what became of several maps in one. Where a map has more
//! than 1000 cells a side a pixel shows several of them, and walls win, so that a thin wall
//! of a large map stays visible. The highest row of a grid is at the top of its picture.
//!
//! ```
//! use ogm_core::{GridFrame, OccupancyGrid, Se2};
//! use ogm_view::{COMMON_WALL, SOURCE_WALL, TARGET_WALL, overlay};
//!
//! let frame = GridFrame::new(0.05, Se2::identity())?;
//! let wall = OccupancyGrid::from_ascii(frame, "##")?;
//! let picture = overlay(&wall, &wall, Se2::new(0.05, 0.0, 0.0))?;
//! let row: Vec<_> = (2..5).map(|x| *picture.get_pixel(x, 2)).collect();
//! assert_eq!(row, [TARGET_WALL, COMMON_WALL, SOURCE_WALL]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod claims;
mod error;
mod overlay;
mod palette;
mod raster;
mod sheet;

pub use claims::{Claimed, marked, provenance};
pub use error::ViewError;
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use overlay::{overlay, overlay_all, seen_on};
pub use palette::{
    BLANK, COMMON_WALL, CONFLICT, FREE, SOURCE_WALL, TARGET_WALL, UNKNOWN, wall_colour,
    wall_colour_name,
};
pub use raster::{crop_known, enlarge, occupancy, paint, png, reduce, side_by_side};
pub use sheet::{Named, motion_sheet, overlay_sheet};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
