//! What the `image` crate decodes, with the size checked before anything is allocated.

use std::io::Cursor;

use image::codecs::bmp::BmpDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::tiff::TiffDecoder;
use image::{ColorType, ImageDecoder, Limits};
use ogm_core::cell_count;

use crate::MapImageError;
use crate::allocate::zeroes;
use crate::raster::{Channels, Raster, Samples};

/// For metadata and a strip of rows, beyond the pixels themselves.
const SCRATCH_BYTES: u64 = 64 << 20;

/// The most pixels of one byte: deflate expands at most 1032-fold, and a byte holds at most eight
/// pixels. No other packing comes near with a picture of a building.
const PIXELS_A_BYTE: usize = 8 * 1032;

pub(crate) fn bmp(bytes: &[u8]) -> Result<Raster, MapImageError> {
    let decoder = BmpDecoder::new(Cursor::new(bytes)).map_err(|error| failed("BMP", &error))?;
    pixels(decoder, "BMP", bytes.len())
}

pub(crate) fn jpeg(bytes: &[u8]) -> Result<Raster, MapImageError> {
    // The decoder fills what is missing with grey.
    let end = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    if !bytes[..end].ends_with(&[0xff, 0xd9]) {
        return Err(refusal("JPEG", "it has no end mark; the file is cut short"));
    }
    let decoder = JpegDecoder::new(Cursor::new(bytes)).map_err(|error| failed("JPEG", &error))?;
    pixels(decoder, "JPEG", bytes.len())
}

/// The first picture of a TIFF.
pub(crate) fn tiff(bytes: &[u8]) -> Result<Raster, MapImageError> {
    let decoder = TiffDecoder::new(Cursor::new(bytes)).map_err(|error| failed("TIFF", &error))?;
    pixels(decoder, "TIFF", bytes.len())
}

/// The pixels of a decoder of a file of `file_bytes` bytes, palettes resolved.
pub(crate) fn pixels(
    mut decoder: impl ImageDecoder,
    format: &'static str,
    file_bytes: usize,
) -> Result<Raster, MapImageError> {
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    let cells = cell_count(width, height)?;
    let bits = usize::from(decoder.original_color_type().bits_per_pixel()).max(1);
    let most = file_bytes.saturating_mul(PIXELS_A_BYTE) / bits;
    if cells > most {
        return Err(MapImageError::WrongLength { width, height, need: cells, found: most });
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
        other => return Err(refusal(format, &format!("its pixels are of type {other:?}"))),
    };
    let total = decoder.total_bytes();
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(total.saturating_add(SCRATCH_BYTES));
    decoder.set_limits(limits).map_err(|error| failed(format, &error))?;
    let mut data = zeroes(cells * channels.count() * if wide { 2 } else { 1 })?;
    decoder.read_image(&mut data).map_err(|error| failed(format, &error))?;
    let (max, samples) = if wide {
        let pairs = data.as_chunks::<2>().0;
        let samples = pairs.iter().map(|&pair| u16::from_ne_bytes(pair)).collect();
        (u16::MAX, Samples::Wide(samples))
    } else {
        (255, Samples::Narrow(data))
    };
    Ok(Raster { width, height, max, channels, samples })
}

pub(crate) fn failed(format: &'static str, error: &image::ImageError) -> MapImageError {
    refusal(format, &error.to_string())
}

pub(crate) fn refusal(format: &'static str, message: &str) -> MapImageError {
    MapImageError::Codec { format, message: message.to_owned() }
}
