//! Grey portable maps: plain (P2) and raw (P5), after the PGM format description of Netpbm.

use ogm_core::cell_count;

use crate::MapImageError;
use crate::error::excerpt;
use crate::raster::{Channels, Raster, Samples};

/// Decodes P2 or P5, 8 or 16 bit; nothing larger than the file is allocated.
pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, MapImageError> {
    let plain = match bytes {
        [b'P', b'2', next, ..] if ends_token(*next) => true,
        [b'P', b'5', next, ..] if ends_token(*next) => false,
        _ => {
            return Err(MapImageError::Format { start: excerpt(bytes) });
        }
    };
    let mut cursor = Cursor { rest: &bytes[2..] };
    let width = cursor.header_field("width", usize::MAX)?;
    let height = cursor.header_field("height", usize::MAX)?;
    let cells = cell_count(width, height)?;
    let max = cursor.header_field("maximum", usize::from(u16::MAX))?;
    let max = u16::try_from(max).unwrap_or(u16::MAX);
    let wrong_length = |found| MapImageError::WrongLength { width, height, need: cells, found };
    let samples = if plain {
        cursor.plain_samples(cells, max)?.map_err(wrong_length)?
    } else {
        cursor.raw_samples(cells, max)?.map_err(wrong_length)?
    };
    Ok(Raster { width, height, max, channels: Channels::Grey, samples })
}

/// An 8-bit raw PGM of grey levels, top row first.
pub(crate) fn encode(width: usize, height: usize, levels: &[u8]) -> Vec<u8> {
    let mut file = format!("P5\n{width} {height}\n255\n").into_bytes();
    file.extend_from_slice(levels);
    file
}

struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    /// The next word, or nothing at the end; comments run from `#` to the end of the line.
    fn token(&mut self) -> &'a [u8] {
        loop {
            match self.rest {
                [b'#', ..] => self.skip_line(),
                [byte, rest @ ..] if is_space(*byte) => self.rest = rest,
                _ => break,
            }
        }
        let length = length_until(self.rest, ends_token);
        let (token, rest) = self.rest.split_at(length);
        self.rest = rest;
        token
    }

    fn skip_line(&mut self) {
        let line = length_until(self.rest, |byte| byte == b'\n' || byte == b'\r');
        self.rest = self.rest.get(line + 1..).unwrap_or(&[]);
    }

    fn header_field(&mut self, field: &'static str, max: usize) -> Result<usize, MapImageError> {
        let token = self.token();
        number(token)
            .filter(|value| (1..=max).contains(value))
            .ok_or_else(|| MapImageError::PgmHeader { field, max, found: excerpt(token) })
    }

    /// Decimal samples; the inner error is how many there are if not `cells`.
    fn plain_samples(
        &mut self,
        cells: usize,
        max: u16,
    ) -> Result<Result<Samples, usize>, MapImageError> {
        // A sample takes a digit and a separator.
        let mut samples = Vec::with_capacity(cells.min(self.rest.len() / 2 + 1));
        loop {
            let token = self.token();
            if token.is_empty() {
                break;
            }
            let sample = number(token)
                .and_then(|value| u16::try_from(value).ok())
                .filter(|&value| value <= max)
                .ok_or_else(|| pixel_error(samples.len(), excerpt(token), max))?;
            samples.push(sample);
            if samples.len() > cells {
                break;
            }
        }
        if samples.len() == cells { Ok(Ok(Samples::Wide(samples))) } else { Ok(Err(samples.len())) }
    }

    /// Binary samples; the inner error is how many there are if not `cells`.
    fn raw_samples(
        &mut self,
        cells: usize,
        max: u16,
    ) -> Result<Result<Samples, usize>, MapImageError> {
        let width = if max > 255 { 2 } else { 1 };
        let need = cells * width;
        match self.rest {
            [b'#', ..] => self.skip_line(),
            // A header that went through a tool for Windows text ends in two bytes.
            [b'\r', b'\n', rest @ ..] if rest.len() == need => self.rest = rest,
            [_, rest @ ..] => self.rest = rest,
            [] => {}
        }
        let Some((data, trailer)) = self.rest.split_at_checked(need) else {
            return Ok(Err(self.rest.len() / width));
        };
        if !trailer.iter().copied().all(is_space) {
            return Ok(Err(self.rest.len().div_ceil(width)));
        }
        let samples = if width == 1 {
            Samples::Narrow(data.to_vec())
        } else {
            let pairs = data.as_chunks::<2>().0;
            Samples::Wide(pairs.iter().map(|&pair| u16::from_be_bytes(pair)).collect())
        };
        match first_above(&samples, max) {
            Some((index, value)) => Err(pixel_error(index, value.to_string(), max)),
            None => Ok(Ok(samples)),
        }
    }
}

fn first_above(samples: &Samples, max: u16) -> Option<(usize, u16)> {
    let above = |&(_, value): &(usize, u16)| value > max;
    match samples {
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
