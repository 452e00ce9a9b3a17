//! PNG through the `image` crate, with the size checked before anything is decoded.

use std::io::Cursor;

use image::codecs::png::{PngDecoder, PngEncoder};
use image::{ColorType, ExtendedColorType, ImageDecoder, ImageEncoder, ImageError, Limits};
use ogm_core::cell_count;

use crate::MapImageError;
use crate::raster::{Channels, Raster, Samples};

/// For metadata and one row; the pixels are bounded by [`cell_count`] and by [`plausible`].
const SCRATCH_BYTES: u64 = 64 << 20;

/// Deflate expands at most this many fold.
const DEFLATE_RATIO: usize = 1032;

/// Decodes a PNG of any colour type, palettes resolved.
pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, MapImageError> {
    let [width, height] = stated_size(bytes).ok_or_else(|| refusal("the PNG has no header"))?;
    let cells = cell_count(width, height)?;
    let found = plausible(bytes);
    if cells > found {
        return Err(MapImageError::WrongLength { width, height, need: cells, found });
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(SCRATCH_BYTES);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(png_error)?;
    if decoder.is_apng().map_err(png_error)? {
        return Err(refusal("an animated PNG is not a map; save a single frame"));
    }
    if !ends_properly(bytes) {
        return Err(refusal("the PNG has no end mark; the file is cut short"));
    }
    let (channels, wide) = match decoder.color_type() {
        ColorType::L8 => (Channels::Grey, false),
        ColorType::La8 => (Channels::GreyAlpha, false),
        ColorType::Rgb8 => (Channels::Rgb, false),
        ColorType::Rgba8 => (Channels::RgbAlpha, false),
        ColorType::L16 => (Channels::Grey, true),
        ColorType::La16 => (Channels::GreyAlpha, true),
        ColorType::Rgb16 => (Channels::Rgb, true),
        ColorType::Rgba16 => (Channels::RgbAlpha, true),
        _ => return Err(refusal("its colour type is not one that PNG defines")),
    };
    let bits = usize::from(decoder.original_color_type().bits_per_pixel());
    let need = (cells * bits).div_ceil(8);
    let found = bytes.len().saturating_mul(DEFLATE_RATIO);
    if need > found {
        return Err(MapImageError::WrongLength { width, height, need, found });
    }
    let mut data = vec![0; cells * channels.count() * if wide { 2 } else { 1 }];
    decoder.read_image(&mut data).map_err(png_error)?;
    let (max, samples) = if wide {
        let pairs = data.as_chunks::<2>().0;
        let samples = pairs.iter().map(|&pair| u16::from_ne_bytes(pair)).collect();
        (u16::MAX, Samples::Wide(samples))
    } else {
        (255, Samples::Narrow(data))
    };
    Ok(Raster { width, height, max, channels, samples })
}

/// A PNG of (grey, alpha) pairs, top row first.
pub(crate) fn encode_grey_alpha(
    width: usize,
    height: usize,
    pairs: &[u8],
) -> Result<Vec<u8>, MapImageError> {
    let too_wide = |_| refusal("too wide or too high for a PNG");
    let width = u32::try_from(width).map_err(too_wide)?;
    let height = u32::try_from(height).map_err(too_wide)?;
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(pairs, width, height, ExtendedColorType::La8)
        .map_err(png_error)?;
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

/// The most pixels that a PNG of this length can hold: deflate expands at most 1032-fold, and a
/// byte holds at most eight pixels.
fn plausible(bytes: &[u8]) -> usize {
    bytes.len().saturating_mul(8 * DEFLATE_RATIO)
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

fn png_error(error: ImageError) -> MapImageError {
    MapImageError::Png { message: error.to_string() }
}

fn refusal(message: &str) -> MapImageError {
    MapImageError::Png { message: message.to_owned() }
}
