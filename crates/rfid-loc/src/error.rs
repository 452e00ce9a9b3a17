//! What cannot be meant as a reading, an estimate or a parameter.

use ogm_core::{Cancelled, GridError, ParameterError, TagId};

/// Input that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TagError {
    /// A filter parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A position that is not finite, or further than 10⁹ m from the origin.
    #[error("a position must be finite and within 1e9 m of the origin, got ({x}, {y})")]
    Position {
        /// x, metres.
        x: f64,
        /// y, metres.
        y: f64,
    },
    /// A range that is not finite, negative, or longer than the sensor can give.
    #[error("a range must lie in 0..={limit} m, got {range}")]
    Range {
        /// The range, metres.
        range: f64,
        /// Longest range that is believed, metres.
        limit: f64,
    },
    /// An estimate with an impossible position or certainty.
    #[error("tag {tag_id} has no usable estimate: position ({x}, {y}) m, certainty {certainty}")]
    Estimate {
        /// Which tag.
        tag_id: TagId,
        /// x, metres.
        x: f64,
        /// y, metres.
        y: f64,
        /// Certainty, in [0, 1] if it were usable.
        certainty: f64,
    },
    /// Two estimates of one tag in one map.
    #[error("tag {tag_id} occurs twice in one map")]
    DuplicateTag {
        /// Which tag.
        tag_id: TagId,
    },
    /// A search area that is no grid, or a rotation that is not finite.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The call was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
