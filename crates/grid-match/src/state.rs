//! What a map says of a cell.

/// Ordered by how much it says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum State {
    Unknown,
    Free,
    /// The face of a wall; what lies behind it is unknown.
    Wall,
}
