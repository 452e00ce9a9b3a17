//! What is wrong with a message.

use ogm_core::GridError;

/// A message that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MessageError {
    /// Too short for the four bytes that say how the others are laid out.
    #[error("the message has {bytes} bytes; its header alone has 4")]
    TooShort {
        /// Bytes that there are.
        bytes: usize,
    },
    /// Another encoding than plain CDR.
    #[error(
        "the message is in encoding {identifier:#06x}; only plain CDR is read, 0x0000 and 0x0001"
    )]
    Encoding {
        /// The identifier in its first two bytes.
        identifier: u16,
    },
    /// The bytes do not have the fields of the message.
    #[error("not a {name}: {message}")]
    Malformed {
        /// The Rust name of the message.
        name: &'static str,
        /// What the decoder says.
        message: String,
    },
    /// Cells that do not fill the stated size.
    #[error("the map says {width} × {height}, {need} cells, but has {found}")]
    WrongLength {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Their product.
        need: u64,
        /// Cells that there are.
        found: usize,
    },
    /// A size, a resolution or an origin outside what a grid may have.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A pose that is not flat on the ground.
    #[error("the pose is tilted by {degrees:.1}°; a map on a floor has a yaw only")]
    Tilted {
        /// Angle between its z axis and the vertical, degrees.
        degrees: f64,
    },
    /// More than fits into the fields of the message.
    #[error("{what} does not fit into the message")]
    TooLarge {
        /// Which.
        what: &'static str,
    },
}
