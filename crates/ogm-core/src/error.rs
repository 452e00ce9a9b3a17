//! What cannot be meant as a grid.

/// A grid, frame or cell value that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// Width or height is zero.
    #[error("a grid of {width} × {height} cells has no area")]
    ZeroArea {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// More cells than [`crate::MAX_CELLS`].
    #[error(
        "a grid of {width} × {height} cells exceeds the limit of {limit} cells; crop it or use a coarser resolution"
    )]
    TooLarge {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Most cells that a grid may have.
        limit: usize,
    },
    /// The number of cells is not width × height.
    #[error("{cells} cells do not fill a grid of {width} × {height}")]
    WrongCellCount {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Cells that were given.
        cells: usize,
    },
    /// A resolution outside the accepted range, or no number.
    #[error(
        "a resolution of {resolution:?} m a cell is no map's: {least} to {most} m are accepted"
    )]
    Resolution {
        /// Metres a cell.
        resolution: f64,
        /// Least metres a cell.
        least: f64,
        /// Most metres a cell.
        most: f64,
    },
    /// An origin too far from zero, or no number.
    #[error(
        "an origin at ({x:?}, {y:?}) m is too far away: at most {limit} m along either axis are accepted"
    )]
    Origin {
        /// Origin x, metres.
        x: f64,
        /// Origin y, metres.
        y: f64,
        /// Largest |x| and |y|, metres.
        limit: f64,
    },
    /// Two grids that must share a lattice do not.
    #[error(
        "grids differ: {a_width} × {a_height} cells of {a_resolution} m against {b_width} × {b_height} of {b_resolution} m; resample one onto the other's frame"
    )]
    ResolutionMismatch {
        /// Columns of the first grid.
        a_width: usize,
        /// Rows of the first grid.
        a_height: usize,
        /// Metres a cell of the first grid.
        a_resolution: f64,
        /// Columns of the second grid.
        b_width: usize,
        /// Rows of the second grid.
        b_height: usize,
        /// Metres a cell of the second grid.
        b_resolution: f64,
    },
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
    /// A picture of a grid has a character that stands for nothing.
    #[error(
        "line {line} of the picture has {character:?}; use '#' occupied, '.' free, '?' unknown"
    )]
    UnknownCharacter {
        /// Line from the top, from 1.
        line: usize,
        /// What was found there.
        character: char,
    },
    /// Class thresholds out of order.
    #[error(
        "class thresholds must satisfy 0 < free < 0.5 < occupied < 1, got free {free}, occupied {occupied}"
    )]
    InvalidThresholds {
        /// Free at or below.
        free: f64,
        /// Occupied at or above.
        occupied: f64,
    },
}
