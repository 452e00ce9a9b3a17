//! What cannot be drawn.

use ogm_core::GridError;

/// A picture that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
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
    /// A grid of impossible size, or a transform with a NaN or infinite part.
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
