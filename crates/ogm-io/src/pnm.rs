//! Portable bit, grey and pixel maps, plain (P1 to P3) and raw (P4 to P6), after Netpbm's
//! descriptions of the formats.

use ogm_core::cell_count;

use crate::MapImageError;
use crate::allocate::room;
use crate::error::excerpt;
use crate::raster::{Channels, Raster, Samples};

/// Decodes P1 to P6, up to 16 bit; nothing much larger than the file is allocated, and of a raw
/// 8-bit file nothing at all.
pub(crate) fn decode(bytes: Vec<u8>) -> Result<Raster, MapImageError> {
    let (kind, mut cursor) = start(&bytes)?;
    let width = cursor.header_field("width", usize::MAX)?;
    let height = cursor.header_field("height", usize::MAX)?;
    let cells = cell_count(width, height)?;
    let max = if matches!(kind, 1 | 4) {
        1
    } else {
        let max = cursor.header_field("maximum", usize::from(u16::MAX))?;
        u16::try_from(max).unwrap_or(u16::MAX)
    };
    let channels = if matches!(kind, 3 | 6) { Channels::Rgb } else { Channels::Grey };
    let count = cells * channels.count();
    let wrong_length = |found: usize| {
        let found = found / channels.count();
        MapImageError::WrongLength { width, height, need: cells, found }
    };
    let samples = match kind {
        1 => Samples::Narrow(cursor.plain_bits(cells)?.map_err(wrong_length)?),
        2 | 3 => Samples::Wide(cursor.plain_samples(count, max)?.map_err(wrong_length)?),
        4 => {
            let row = width.div_ceil(8);
            let data = cursor.raw_data(row * height).map_err(|found| wrong_length(found * 8))?;
            Samples::Narrow(bits(data, width)?)
        }
        _ if max > 255 => {
            let data = cursor.raw_data(count * 2).map_err(|found| wrong_length(found / 2))?;
            let mut samples = room(count)?;
            samples.extend(data.as_chunks::<2>().0.iter().map(|&pair| u16::from_be_bytes(pair)));
            Samples::Wide(samples)
        }
        _ => {
            cursor.raw_data(count).map_err(wrong_length)?;
            let start = bytes.len() - cursor.rest.len();
            let mut samples = bytes;
            samples.copy_within(start..start + count, 0);
            samples.truncate(count);
            Samples::Narrow(samples)
        }
    };
    match first_above(&samples, max) {
        Some((index, value)) => Err(pixel_error(index, value.to_string(), max)),
        None => Ok(Raster { width, height, max, channels, samples }),
    }
}

/// Width, height, and bytes a pixel while its samples become cells, none where it is its cell.
pub(crate) fn size(head: &[u8]) -> Result<(usize, usize, u64), MapImageError> {
    let (kind, mut cursor) = start(head)?;
    let width = cursor.header_field("width", usize::MAX)?;
    let height = cursor.header_field("height", usize::MAX)?;
    let is_wide = !matches!(kind, 1 | 4)
        && cursor.header_field("maximum", usize::from(u16::MAX))? > usize::from(u8::MAX);
    let pixel = match kind {
        1 | 4 => 1,
        2 => 3,
        3 => 7,
        5 if !is_wide => 0,
        5 => 3,
        _ if is_wide => 7,
        _ => 1,
    };
    Ok((width, height, pixel))
}

/// Which of the six, and what follows.
fn start(bytes: &[u8]) -> Result<(u8, Cursor<'_>), MapImageError> {
    match bytes {
        [b'P', digit @ b'1'..=b'6', next, ..] if ends_token(*next) => {
            Ok((digit - b'0', Cursor { rest: &bytes[2..] }))
        }
        _ => Err(MapImageError::Format { start: excerpt(bytes) }),
    }
}

/// What stands before the pixels of an 8-bit raw PGM.
pub(crate) fn grey_header(width: usize, height: usize) -> String {
    format!("P5\n{width} {height}\n255\n")
}

struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    /// The next word, or nothing at the end; comments run from `#` to the end of the line.
    fn token(&mut self) -> &'a [u8] {
        self.skip_space();
        let length = length_until(self.rest, ends_token);
        let (token, rest) = self.rest.split_at(length);
        self.rest = rest;
        token
    }

    fn skip_space(&mut self) {
        loop {
            match self.rest {
                [b'#', ..] => self.skip_line(),
                [byte, rest @ ..] if is_space(*byte) => self.rest = rest,
                _ => break,
            }
        }
    }

    fn skip_line(&mut self) {
        let line = length_until(self.rest, |byte| byte == b'\n' || byte == b'\r');
        self.rest = self.rest.get(line + 1..).unwrap_or(&[]);
    }

    fn header_field(&mut self, field: &'static str, max: usize) -> Result<usize, MapImageError> {
        let token = self.token();
        number(token)
            .filter(|value| (1..=max).contains(value))
            .ok_or_else(|| MapImageError::PnmHeader { field, max, found: excerpt(token) })
    }

    /// Decimal samples; the inner error is how many there are if not `count`.
    fn plain_samples(
        &mut self,
        count: usize,
        max: u16,
    ) -> Result<Result<Vec<u16>, usize>, MapImageError> {
        // A sample takes a digit and a separator.
        let mut samples = room(count.min(self.rest.len() / 2 + 1))?;
        loop {
            let token = self.token();
            if token.is_empty() {
                break;
            }
            if samples.len() == count {
                return Ok(Err(count + 1));
            }
            let sample = number(token)
                .and_then(|value| u16::try_from(value).ok())
                .filter(|&value| value <= max)
                .ok_or_else(|| pixel_error(samples.len(), excerpt(token), max))?;
            samples.push(sample);
        }
        if samples.len() == count { Ok(Ok(samples)) } else { Ok(Err(samples.len())) }
    }

    /// Brightness from plain bits, of which 1 is black and which need no space between them.
    fn plain_bits(&mut self, count: usize) -> Result<Result<Vec<u8>, usize>, MapImageError> {
        let mut samples = room(count.min(self.rest.len()))?;
        loop {
            self.skip_space();
            let Some((&digit, rest)) = self.rest.split_first() else { break };
            if samples.len() == count {
                return Ok(Err(count + 1));
            }
            samples.push(match digit {
                b'0' => 1,
                b'1' => 0,
                _ => return Err(pixel_error(samples.len(), excerpt(&[digit]), 1)),
            });
            self.rest = rest;
        }
        if samples.len() == count { Ok(Ok(samples)) } else { Ok(Err(samples.len())) }
    }

    /// The `need` bytes behind the header, where the cursor then stands; the error is how many there
    /// are.
    fn raw_data(&mut self, need: usize) -> Result<&'a [u8], usize> {
        match self.rest {
            [b'#', ..] => self.skip_line(),
            // A header that went through a tool for Windows text ends in two bytes.
            [b'\r', b'\n', rest @ ..] if rest.len() == need => self.rest = rest,
            [_, rest @ ..] => self.rest = rest,
            [] => {}
        }
        match self.rest.split_at_checked(need) {
            Some((data, trailer)) if trailer.iter().copied().all(is_space) => Ok(data),
            _ => Err(self.rest.len()),
        }
    }
}

/// Brightness from rows of packed bits, of which 1 is black.
fn bits(data: &[u8], width: usize) -> Result<Vec<u8>, MapImageError> {
    let row = width.div_ceil(8);
    let mut samples = room(data.len() / row * width)?;
    for row in data.chunks_exact(row) {
        samples.extend((0..width).map(|column| !row[column / 8] >> (7 - column % 8) & 1));
    }
    Ok(samples)
}

fn first_above(samples: &Samples, max: u16) -> Option<(usize, u16)> {
    let above = |&(_, value): &(usize, u16)| value > max;
    match samples {
        Samples::Narrow(_) if max >= 255 => None,
        Samples::Narrow(samples) => samples.iter().map(|&s| u16::from(s)).enumerate().find(above),
        Samples::Wide(samples) => samples.iter().copied().enumerate().find(above),
    }
}

fn pixel_error(index: usize, found: String, max: u16) -> MapImageError {
    MapImageError::Pixel { index, found, max }
}

fn number(token: &[u8]) -> Option<usize> {
    if token.iter().all(u8::is_ascii_digit) {
        str::from_utf8(token).ok()?.parse().ok()
    } else {
        None
    }
}

fn length_until(bytes: &[u8], end: impl Fn(u8) -> bool) -> usize {
    bytes.iter().position(|&byte| end(byte)).unwrap_or(bytes.len())
}

fn ends_token(byte: u8) -> bool {
    is_space(byte) || byte == b'#'
}

fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | 0x0b | 0x0c | b'\r')
}
