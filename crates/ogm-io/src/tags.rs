//! Tag readings as CSV: one line a reading.

use std::fmt::Write;
use std::path::Path;

use nalgebra::Point2;
use ogm_core::{TagIdError, TagReading};

use crate::bounded::read_at_most;
use crate::{IoError, TAG_LOG_HEADER, TagLogError, write_file};

/// Some five million readings.
const MAX_BYTES: u64 = 256 << 20;

/// Reads a tag log.
///
/// # Errors
/// A file that cannot be opened, or one that [`parse_tags`] refuses.
pub fn read_tags(path: &Path) -> Result<Vec<TagReading>, IoError> {
    let bytes = read_at_most(path, MAX_BYTES).map_err(|cause| IoError::Access {
        path: path.to_owned(),
        action: "read",
        cause,
    })?;
    parse_tags(&bytes).map_err(|cause| IoError::Tags { path: path.to_owned(), cause })
}

/// Writes a tag log, to the last digit; an existing file is replaced at once or not at all.
///
/// # Errors
/// A reading that could not be read back (a number that is not finite, a negative range), or a
/// folder that cannot be written.
pub fn write_tags(path: &Path, readings: &[TagReading]) -> Result<(), IoError> {
    let text =
        format_tags(readings).map_err(|cause| IoError::Tags { path: path.to_owned(), cause })?;
    write_file(path, text.as_bytes(), true)
}

/// The readings in the bytes of a tag log. Blank lines and spaces around values are ignored.
///
/// ```
/// use ogm_io::{TAG_LOG_HEADER, parse_tags};
///
/// let log = format!("{TAG_LOG_HEADER}\n7, 1.5, -0.25, 2.125\n");
/// assert_eq!(parse_tags(log.as_bytes())?[0].range, 2.125);
/// # Ok::<(), ogm_io::TagLogError>(())
/// ```
///
/// # Errors
/// Bytes that are not UTF-8, another header than [`TAG_LOG_HEADER`], a line without exactly four
/// values, an identifier that is no [`TagId`](ogm_core::TagId), a number that is not finite, a negative range.
pub fn parse_tags(csv: &[u8]) -> Result<Vec<TagReading>, TagLogError> {
    let text = str::from_utf8(csv).map_err(|error| TagLogError::NotText {
        line: 1 + csv.iter().take(error.valid_up_to()).filter(|&&b| b == b'\n').count(),
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines();
    let header = lines.next().unwrap_or("");
    if !header.split(',').map(str::trim).eq(TAG_LOG_HEADER.split(',')) {
        return Err(TagLogError::Header { found: header.to_owned() });
    }
    lines
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty())
        .map(|(index, line)| parse_line(index + 2, line))
        .collect()
}

fn parse_line(line: usize, text: &str) -> Result<TagReading, TagLogError> {
    let values: Vec<&str> = text.split(',').map(str::trim).collect();
    let [tag_id, x, y, range] = values[..] else {
        return Err(TagLogError::Columns { line, found: values.len(), text: text.to_owned() });
    };
    let tag_id = tag_id.parse().map_err(|TagIdError(text)| {
        value_error(
            line,
            "tag_id",
            text,
            "a whole number or the 24 or 32 hexadecimal digits of an EPC",
        )
    })?;
    let number = |column, text: &str| {
        let value = text.parse().unwrap_or(f64::NAN);
        check(line, column, value, text)
    };
    Ok(TagReading {
        tag_id,
        robot_position: Point2::new(number("robot_x_m", x)?, number("robot_y_m", y)?),
        range: number("range_m", range)?,
    })
}

fn format_tags(readings: &[TagReading]) -> Result<String, TagLogError> {
    let mut text = format!("{TAG_LOG_HEADER}\n");
    for (index, reading) in readings.iter().enumerate() {
        let line = index + 2;
        let number = |column, value: f64| check(line, column, value, &value.to_string());
        let x = number("robot_x_m", reading.robot_position.x)?;
        let y = number("robot_y_m", reading.robot_position.y)?;
        let range = number("range_m", reading.range)?;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{x:?},{y:?},{range:?}", reading.tag_id);
    }
    Ok(text)
}

fn check(line: usize, column: &'static str, value: f64, text: &str) -> Result<f64, TagLogError> {
    let is_range = column == "range_m";
    if value.is_finite() && !(is_range && value < 0.0) {
        return Ok(value);
    }
    let expected = if is_range {
        "a finite number of metres, not negative"
    } else {
        "a finite number of metres"
    };
    Err(value_error(line, column, text.to_owned(), expected))
}

fn value_error(
    line: usize,
    column: &'static str,
    value: String,
    expected: &'static str,
) -> TagLogError {
    TagLogError::Value { line, column, value, expected }
}
