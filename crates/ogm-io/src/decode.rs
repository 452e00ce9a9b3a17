//! Which format the bytes of an image have.

use crate::error::excerpt;
use crate::raster::Raster;
use crate::{MapImageError, pgm, png};

/// Decodes by content; the extension of a file says nothing.
pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, MapImageError> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::decode(bytes),
        [b'P', b'2' | b'5', ..] => pgm::decode(bytes),
        _ => Err(MapImageError::Format { start: excerpt(bytes) }),
    }
}
