//! What a map will take, from the heads of its files.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek};
use std::path::Path;

use image::ImageDecoder;
use image::codecs::bmp::BmpDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::codecs::tiff::TiffDecoder;
use ogm_core::cell_count;

use crate::format::Format;
use crate::{IoError, MapImageError, codec, pnm};

/// The size of a map that is not read yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapSize {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The most memory that reading it takes at one time, the cells themselves included, bytes.
    pub reading_bytes: u64,
}

impl MapSize {
    /// The size of the image at `path`, from its head alone.
    ///
    /// # Errors
    /// A file that cannot be opened, is no image of a format that is read, or has too many cells.
    pub fn of_image(path: &Path) -> Result<Self, IoError> {
        let access = |cause| IoError::Access { path: path.to_owned(), action: "read", cause };
        let image = |cause| IoError::Image { path: path.to_owned(), cause };
        let file = File::open(path).map_err(access)?;
        let file_bytes = file.metadata().map_err(access)?.len();
        let mut file = BufReader::new(file);
        let mut head = Vec::new();
        file.by_ref().take(HEAD_BYTES).read_to_end(&mut head).map_err(access)?;
        file.rewind().map_err(access)?;
        let (width, height, pixel) = match Format::of(&head) {
            Some(Format::Pnm) => pnm::size(&head).map_err(image)?,
            Some(format) => decoded_size(file, format).map_err(image)?,
            None => return Err(image(crate::decode::unknown(&head))),
        };
        let cells = cell_count(width, height).map_err(|error| image(error.into()))? as u64;
        let reading_bytes = if pixel == 0 {
            // The file becomes the cells where it lies.
            file_bytes
        } else {
            file_bytes.saturating_add(cells.saturating_mul(pixel))
        };
        Ok(Self { width, height, reading_bytes })
    }

    /// Width times height.
    #[must_use]
    pub fn cells(&self) -> u64 {
        self.width as u64 * self.height as u64
    }
}

/// Enough for the comments that programs write before the numbers.
const HEAD_BYTES: u64 = 1 << 12;

/// Width, height, and bytes a pixel while its samples become cells.
fn decoded_size(
    file: impl BufRead + Seek,
    format: Format,
) -> Result<(usize, usize, u64), MapImageError> {
    match format {
        Format::Bmp => size(BmpDecoder::new(file), "BMP"),
        Format::Jpeg => size(JpegDecoder::new(file), "JPEG"),
        Format::Tiff => size(TiffDecoder::new(file), "TIFF"),
        Format::Png | Format::Pnm => size(PngDecoder::new(file), "PNG"),
    }
}

fn size<D: ImageDecoder>(
    decoder: image::ImageResult<D>,
    format: &'static str,
) -> Result<(usize, usize, u64), MapImageError> {
    let decoder = decoder.map_err(|error| codec::failed(format, &error))?;
    let (width, height) = decoder.dimensions();
    let colour = decoder.color_type();
    let (channels, bytes) = (colour.channel_count(), colour.bytes_per_pixel());
    // Grey of 8 bits becomes cells where it lies, 16 bits are swapped once more.
    let pixel = match bytes / channels {
        1 if channels == 1 => 1,
        1 => bytes + 1,
        _ => 2 * bytes + 1,
    };
    Ok((width as usize, height as usize, pixel.into()))
}
