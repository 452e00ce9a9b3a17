//! From the bytes of an image to its pixels.

use crate::error::excerpt;
use crate::format::Format;
use crate::lfs::is_lfs_pointer;
use crate::raster::Raster;
use crate::{MapImageError, codec, png, pnm};

/// Decodes by content.
pub(crate) fn decode(bytes: Vec<u8>) -> Result<Raster, MapImageError> {
    match Format::of(&bytes) {
        Some(Format::Pnm) => pnm::decode(bytes),
        Some(Format::Png) => png::decode(&bytes),
        Some(Format::Bmp) => codec::bmp(&bytes),
        Some(Format::Jpeg) => codec::jpeg(&bytes),
        Some(Format::Tiff) => codec::tiff(&bytes),
        None => Err(unknown(&bytes)),
    }
}

/// What bytes are that are no image.
pub(crate) fn unknown(bytes: &[u8]) -> MapImageError {
    if is_lfs_pointer(bytes) {
        MapImageError::LfsPointer
    } else {
        MapImageError::Format { start: excerpt(bytes) }
    }
}
