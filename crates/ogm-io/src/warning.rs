//! What is suspicious in a map file and still has a meaning.

use std::fmt;

/// Something in a map file that its author may not have meant, and what was made of it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MapWarning {
    /// Grey 205, by which `map_saver` means unknown, lies below `free_thresh` in a file that holds
    /// nothing but 0, 205 and 254; it was read as unknown.
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
        }
    }
}
