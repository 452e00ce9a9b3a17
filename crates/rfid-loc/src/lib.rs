//! Where radio tags are, how surely, and how two maps lie to each other by the tags they share.
//!
//! A robot that reads ranges to a tag while it drives knows where the tag is up to a ring, then up
//! to two mirror images, then, once it has driven a curve, to about a centimetre.
//! [`TagFilter`] is that as a Bayes filter on a grid, [`localise`] runs it over a log. Two robots
//! that know the same three tags know how their maps lie to each other: [`common_tags`] and
//! [`select_tags`] pick them, [`tag_rotation`] and [`quadrant`] turn, [`anchor_on_tag`]
//! translates. [`tag_only_transform`] and [`least_squares_transform`] do without walls.
//!
//! ```
//! use nalgebra::Point2;
//! use ogm_core::TagReading;
//! use rfid_loc::{FilterParams, localise};
//!
//! let tag = Point2::new(1.4, 0.6);
//! let log: Vec<TagReading> = (0..60)
//!     .map(|step| {
//!         let angle = 0.05 * f64::from(step);
//!         let robot_position = Point2::new(angle.sin(), 1.0 - angle.cos());
//!         let range = (tag - robot_position).norm();
//!         TagReading { tag_id: 7.into(), robot_position, range }
//!     })
//!     .collect();
//! let estimates = localise(&log, &FilterParams::default(), &())?;
//! assert!((estimates[0].position - tag).norm() < 0.01);
//! assert!(estimates[0].certainty > 0.75);
//! # Ok::<(), rfid_loc::TagError>(())
//! ```
//!
//! After E. Tsardoulias, A. Thallas, L. Petrou: *Metric Map Merging using RFID Tags & Topological
//! Information*, sections 3, 4.1.3, 4.2 and 5.2, with its misprints corrected. A printed form that
//! the paper's own results may rest on is an option named `AsPrinted`, never a default.
//!
//! Valid input that holds too little is an [`Outcome::Refused`](ogm_core::Outcome); a [`TagError`]
//! is input that cannot be meant.

mod error;
mod filter;
mod fit;
#[cfg(test)]
mod fixture;
mod localise;
mod params;
mod quadrant;
mod rotation;
mod selection;
mod tag_only;
mod transform;
mod window;

pub use error::TagError;
pub use filter::TagFilter;
pub use localise::localise;
/// The grids, frames and poses that the functions here take and give.
pub use ogm_core;
pub use params::{
    CertaintyWindow, FilterParams, Likelihood, PositionRule, RotationCentre, RotationParams,
    SelectionParams, TagFrame, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation,
};
pub use quadrant::{AMBIGUOUS_ABOVE, Quadrant, QuadrantConfidence, quadrant};
pub use rotation::{RotationRule, TagRotation, pair_rotation, tag_rotation};
pub use selection::{TagPair, common_tags, select_tags, select_two_tags, sure_tags};
pub use tag_only::tag_only_transform;
pub use transform::{anchor_on_all_tags, anchor_on_tag, least_squares_transform, tag_residual};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
