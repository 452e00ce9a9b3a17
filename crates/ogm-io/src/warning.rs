//! What is suspicious in a map file and still has a meaning.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::TextEncoding;

/// Something in a map file that its author may not have meant, and what was made of it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MapWarning {
    /// Grey 205, by which `map_saver` means unknown, lies below `free_thresh` in a file that holds
    /// next to no other shade between unknown and free; it was read as unknown.
    GreyReadAsUnknown {
        /// The file's threshold.
        free_thresh: f64,
        /// How many cells.
        cells: usize,
    },
    /// The same, but the literal reading was asked for.
    GreyReadAsFree {
        /// The file's threshold.
        free_thresh: f64,
        /// How many cells.
        cells: usize,
    },
    /// An origin coordinate of 100 m or more with at most three significant digits, as some savers
    /// round it.
    RoundedOrigin {
        /// `x` or `y`.
        axis: char,
        /// The coordinate as written.
        text: String,
        /// How far off it may be, metres.
        error: f64,
    },
    /// The yaw of the origin is NaN, as `map_saver` of ROS 1 may write; it was read as 0.
    YawNotANumber,
    /// A trinary image has an alpha channel; colours alone were classified, and pixels that are
    /// not opaque are unknown.
    AlphaLeftOut {
        /// How many pixels are not opaque.
        translucent: usize,
    },
    /// A trinary image has an alpha channel, and it was averaged in, as was asked for.
    AlphaAveraged,
    /// Many grey levels in a trinary image: perhaps probabilities, of which only classes remain.
    GreyLevels {
        /// How many levels there are.
        levels: usize,
    },
    /// `negate` has no effect in mode `raw`.
    NegateIgnored,
    /// A key stands twice in the YAML; the last value was read.
    DuplicateKey {
        /// The key.
        key: &'static str,
        /// The value that was not read.
        first: String,
        /// The value that was read, unless the key stands there a third time.
        last: String,
    },
    /// The key `mode` is no scalar; it was read as trinary, as ROS 1 does.
    ModeNotAWord {
        /// Its value.
        value: String,
    },
    /// The YAML is not plain UTF-8; it was read as what it is.
    Encoding {
        /// How it is encoded.
        encoding: TextEncoding,
    },
    /// The image is not where the key `image` says; one of its name was read instead.
    ImageElsewhere {
        /// Where the YAML says that it is.
        named: PathBuf,
        /// The image that was read.
        read: PathBuf,
    },
    /// The image is a JPEG, whose greys are not what was saved.
    Lossy,
    /// There is no YAML; the usual thresholds stand in for it.
    NoYaml {
        /// Occupied strictly above this.
        occupied_thresh: f64,
        /// Free strictly below this.
        free_thresh: f64,
    },
}

impl fmt::Display for MapWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GreyReadAsUnknown { free_thresh, cells } => write!(
                f,
                "{cells} cells of grey 205 read as unknown although free_thresh {free_thresh} would make them free; write free_thresh: 0.196"
            ),
            Self::GreyReadAsFree { free_thresh, cells } => write!(
                f,
                "{cells} cells of grey 205 read as free because free_thresh is {free_thresh}; they were probably saved as unknown"
            ),
            Self::RoundedOrigin { axis, text, error } => write!(
                f,
                "origin {axis} = {text} looks rounded to three digits and may be off by {error} m"
            ),
            Self::YawNotANumber => write!(f, "the yaw of the origin is not a number; read as 0"),
            Self::AlphaLeftOut { translucent } => write!(
                f,
                "the image has an alpha channel: {translucent} pixels that are not opaque read as unknown, the others by colour alone; map_server would average alpha in"
            ),
            Self::AlphaAveraged => write!(
                f,
                "the image has an alpha channel, averaged in with the colours as map_server does"
            ),
            Self::GreyLevels { levels } => write!(
                f,
                "{levels} grey levels in a trinary map; if they are probabilities, set mode: scale"
            ),
            Self::NegateIgnored => write!(f, "negate has no effect in mode raw"),
            Self::DuplicateKey { key, first, last } => write!(
                f,
                "the key `{key}` stands twice, as {first} and as {last}; the last one counts here, other programs may take the first: remove one"
            ),
            Self::ModeNotAWord { value } => write!(
                f,
                "`mode: {value}` is none of trinary, scale and raw; read as trinary, as in ROS 1; write mode: trinary"
            ),
            Self::Encoding { encoding } => {
                write!(f, "the YAML is encoded in {}; save it as plain UTF-8", encoding.name())
            }
            Self::ImageElsewhere { named, read } => write!(
                f,
                "`image: {}` is not there; read {} instead; write image: {}",
                named.display(),
                read.display(),
                Path::new(read.file_name().unwrap_or_default()).display()
            ),
            Self::Lossy => write!(
                f,
                "the image is a JPEG, which changes greys: cells near walls may have changed their class; save maps as PNG or PGM"
            ),
            Self::NoYaml { occupied_thresh, free_thresh } => write!(
                f,
                "there is no YAML: read as mode trinary, negate 0, occupied_thresh {occupied_thresh}, free_thresh {free_thresh}"
            ),
        }
    }
}
