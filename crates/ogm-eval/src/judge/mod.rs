//! The one judge: how far an answer is from the truth, and whether that is right.

mod error;
mod overlap;
mod tolerance;
mod truth;
mod verdict;

pub(crate) use error::{NEES_95, PIXEL, PoseError, TransformError, nees};
pub(crate) use overlap::Overlap;
pub(crate) use tolerance::{DIRECTION, HALF_A_DOOR, METHOD_3, SAME_WALLS, Tolerance, UNSEEN, WALK};
pub(crate) use truth::Truth;
pub(crate) use verdict::Verdict;
