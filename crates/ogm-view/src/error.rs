//! What cannot be drawn.

use ogm_core::GridError;

/// A picture that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A transform with a NaN or infinite part.
    #[error("a transform must be finite, got ({x}, {y}, {theta})")]
    NonFiniteTransform {
        /// Translation x, metres.
        x: f64,
        /// Translation y, metres.
        y: f64,
        /// Rotation, radians.
        theta: f64,
    },
    /// No map has a known cell.
    #[error("neither map has a known cell to draw")]
    NothingKnown,
    /// The maps lie too far apart for one picture.
    #[error("the maps span {columns} × {rows} cells together, too many to draw; at most {limit}")]
    TooManyCells {
        /// Columns of the target's lattice.
        columns: i64,
        /// Rows of the target's lattice.
        rows: i64,
        /// Most cells of an overlay.
        limit: i64,
    },
    /// A grid of impossible size.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The PNG encoder gave up.
    #[error("a picture of {width} × {height} pixels: {message}")]
    Png {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// The encoder's words.
        message: String,
    },
}
