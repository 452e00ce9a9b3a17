//! PNG: what the decoder lets pass, and the writing of grey with alpha.

use std::io::Cursor;

use image::codecs::png::{PngDecoder, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, Limits};
use ogm_core::cell_count;

use crate::MapImageError;
use crate::codec::{failed, pixels, refusal};
use crate::raster::Raster;

/// For metadata and one row; the pixels are bounded by their number.
const SCRATCH_BYTES: u64 = 64 << 20;

/// Decodes a PNG of any colour type.
pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, MapImageError> {
    let [width, height] =
        stated_size(bytes).ok_or_else(|| refusal("PNG", "the PNG has no header"))?;
    cell_count(width, height)?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(SCRATCH_BYTES);
    let failed = |error| failed("PNG", &error);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(failed)?;
    if decoder.is_apng().map_err(failed)? {
        return Err(refusal("PNG", "an animated PNG is not a map; save a single frame"));
    }
    if !ends_properly(bytes) {
        return Err(refusal("PNG", "the PNG has no end mark; the file is cut short"));
    }
    pixels(decoder, "PNG", bytes.len())
}

/// A PNG of (grey, alpha) pairs, top row first.
pub(crate) fn encode_grey_alpha(
    width: usize,
    height: usize,
    pairs: &[u8],
) -> Result<Vec<u8>, MapImageError> {
    let too_wide = |_| refusal("PNG", "too wide or too high for a PNG");
    let width = u32::try_from(width).map_err(too_wide)?;
    let height = u32::try_from(height).map_err(too_wide)?;
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(pairs, width, height, ExtendedColorType::La8)
        .map_err(|error| failed("PNG", &error))?;
    Ok(file)
}

/// Width and height, from the first chunk, before a decoder makes room for them.
fn stated_size(bytes: &[u8]) -> Option<[usize; 2]> {
    const SIGNATURE_AND_LENGTH: usize = 12;
    match bytes.get(SIGNATURE_AND_LENGTH..)? {
        [b'I', b'H', b'D', b'R', a, b, c, d, e, f, g, h, ..] => Some(
            [[*a, *b, *c, *d], [*e, *f, *g, *h]].map(|field| u32::from_be_bytes(field) as usize),
        ),
        _ => None,
    }
}

/// Whether the chain of chunks reaches a complete `IEND`.
fn ends_properly(bytes: &[u8]) -> bool {
    const SIGNATURE: usize = 8;
    const LENGTH_TYPE_AND_CHECKSUM: usize = 12;
    let mut rest = bytes.get(SIGNATURE..).unwrap_or(&[]);
    while let [a, b, c, d, kind @ ..] = rest {
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        let Some(next) = rest.get(length.saturating_add(LENGTH_TYPE_AND_CHECKSUM)..) else {
            return false;
        };
        if kind.starts_with(b"IEND") {
            return true;
        }
        rest = next;
    }
    false
}
