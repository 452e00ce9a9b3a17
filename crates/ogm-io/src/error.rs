//! What cannot be read or written, with the file, the place in it, and what to do.

use std::path::PathBuf;

use ogm_core::{Cancelled, GridError};

use crate::tag_columns::TAG_LOG_HEADER;

/// A file that cannot be read or written, or does not hold what it should.
///
/// The text is complete: the cause is part of it and is not repeated as an error source.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The operating system refused.
    #[error("cannot {action} {}: {cause}", path.display())]
    Access {
        /// The file.
        path: PathBuf,
        /// `read` or `write`.
        action: &'static str,
        /// Why.
        cause: std::io::Error,
    },
    /// A map YAML names an image that cannot be opened, nor is there one of its name beside it.
    #[error(
        "cannot read {}: {cause}; the key `image` in {} names it{}",
        places[0].display(),
        yaml.display(),
        others(&places[1..])
    )]
    MissingImage {
        /// The map YAML.
        yaml: PathBuf,
        /// Where it was looked for: first where the YAML says, never empty.
        places: Vec<PathBuf>,
        /// Why that failed.
        cause: std::io::Error,
    },
    /// The map YAML is malformed.
    #[error("{}: {cause}", path.display())]
    Yaml {
        /// The map YAML.
        path: PathBuf,
        /// What is wrong with it.
        cause: YamlError,
    },
    /// The map image is malformed.
    #[error("{}: {cause}", path.display())]
    Image {
        /// The image.
        path: PathBuf,
        /// What is wrong with it.
        cause: MapImageError,
    },
    /// The tag log is malformed, or its readings cannot be written.
    #[error("{}: {cause}", path.display())]
    Tags {
        /// The tag log.
        path: PathBuf,
        /// What is wrong with it.
        cause: TagLogError,
    },
    /// The bag, or the map in it.
    #[cfg(feature = "bags")]
    #[error("{}: {cause}", path.display())]
    Bag {
        /// The bag.
        path: PathBuf,
        /// What is wrong with it.
        cause: crate::BagError,
    },
    /// Cancelled while writing; what was there is as it was.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The output exists and overwriting was not asked for.
    #[error("{} exists; name another output or ask to overwrite it", path.display())]
    Exists {
        /// The existing file.
        path: PathBuf,
    },
}

/// A map YAML that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum YamlError {
    /// Bytes that are no text in UTF-8, UTF-16 or Latin-1.
    #[error("not a text file; name the map's .yaml")]
    NotText,
    /// An image in the place of the YAML.
    #[error("this is an image; name the map's .yaml, which gives its resolution and origin")]
    Image,
    /// What Git LFS left in the place of a file that was not fetched.
    #[error(
        "this is a Git LFS pointer, not the YAML; fetch it with `git lfs pull` in its repository"
    )]
    LfsPointer,
    /// Not a YAML mapping, or a key of the wrong shape.
    #[error("not a map_server YAML: {message}")]
    Syntax {
        /// What the YAML parser says, with line and column.
        message: String,
    },
    /// A required key is absent or empty.
    #[error("key `{key}` is missing; add a line such as `{key}: {example}`")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// A value that would do.
        example: &'static str,
    },
    /// A key whose value is out of its domain.
    #[error("`{key}: {value}`: it must be {expected}")]
    Value {
        /// The key.
        key: &'static str,
        /// Its value as written.
        value: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A resolution or an origin outside what a grid may have.
    #[error("`{key}: {value}`: {cause}")]
    Frame {
        /// The key.
        key: &'static str,
        /// Its value as written.
        value: String,
        /// Which range it is outside of.
        cause: GridError,
    },
    /// The thresholds leave nothing between free and occupied, or overlap.
    #[error(
        "`free_thresh: {free}` must be below `occupied_thresh: {occupied}`; usual values are 0.196 and 0.65"
    )]
    Thresholds {
        /// Free below this.
        free: f64,
        /// Occupied above this.
        occupied: f64,
    },
}

/// A map image that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapImageError {
    /// None of the formats that are read.
    #[error(
        "none of PNM (P1 to P6), PNG, BMP, JPEG and TIFF, it starts with \"{start}\"; convert it to one of them"
    )]
    Format {
        /// The first bytes, escaped.
        start: String,
    },
    /// No area, or too many cells.
    #[error(transparent)]
    Size(#[from] GridError),
    /// What Git LFS left in the place of an image that was not fetched.
    #[error(
        "this is a Git LFS pointer, not the image; fetch it with `git lfs pull` in its repository"
    )]
    LfsPointer,
    /// There is no room for the pixels.
    #[error("there is no memory for {bytes} bytes of it; crop it or free some memory")]
    OutOfMemory {
        /// Bytes that were asked for at once.
        bytes: usize,
    },
    /// A field of a PNM header is not the number it should be.
    #[error("{field} in the PNM header must be a whole number from 1 to {max}, found \"{found}\"")]
    PnmHeader {
        /// Width, height or maximum.
        field: &'static str,
        /// Largest acceptable number.
        max: usize,
        /// What the file has, escaped.
        found: String,
    },
    /// Too little or too much data for the size that the header states.
    #[error(
        "the header says {width} × {height}, {need} pixels, but the data are {found}; the file is cut short or its header is wrong"
    )]
    WrongLength {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Pixels that the header promises.
        need: usize,
        /// Pixels that there are.
        found: usize,
    },
    /// A pixel that is no number or is brighter than the stated maximum.
    #[error("pixel {index} is \"{found}\", not a whole number from 0 to the stated maximum {max}")]
    Pixel {
        /// Which, in file order from 0.
        index: usize,
        /// What the file has, escaped.
        found: String,
        /// The maximum of the header.
        max: u16,
    },
    /// The decoder or encoder of a format gave up.
    #[error("as {format}: {message}; if other programs open it, save it as PNG")]
    Codec {
        /// `PNG`, `BMP`, `JPEG` or `TIFF`.
        format: &'static str,
        /// Its words.
        message: String,
    },
}

/// A tag log that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TagLogError {
    /// Not UTF-8.
    #[error("line {line} is not text; a tag log is CSV in UTF-8")]
    NotText {
        /// Line, from 1.
        line: usize,
    },
    /// The first line is not the header.
    #[error("line 1 is \"{found}\"; it must be \"{}\"", TAG_LOG_HEADER)]
    Header {
        /// What is there.
        found: String,
    },
    /// A line with too many or too few columns.
    #[error("line {line} has {found} columns instead of 4: \"{text}\"")]
    Columns {
        /// Line, from 1.
        line: usize,
        /// Columns that it has.
        found: usize,
        /// The line.
        text: String,
    },
    /// A value out of its domain.
    #[error("line {line}: {column} is \"{value}\"; it must be {expected}")]
    Value {
        /// Line, from 1.
        line: usize,
        /// Column by its name in the header.
        column: &'static str,
        /// The value as written.
        value: String,
        /// What would be accepted.
        expected: &'static str,
    },
}

fn others(places: &[PathBuf]) -> String {
    let places: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
    match &places[..] {
        [] => String::new(),
        places => format!(", and {} cannot be read either", places.join(" and ")),
    }
}

/// The first bytes, escaped for an error message.
pub(crate) fn excerpt(bytes: &[u8]) -> String {
    const LENGTH: usize = 16;
    bytes.iter().take(LENGTH).copied().collect::<Vec<_>>().escape_ascii().to_string()
}
