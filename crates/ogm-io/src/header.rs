//! The YAML half of a map, as ROS `map_server` defines it.

use std::path::PathBuf;

use ogm_core::{GridError, GridFrame, Se2};
use serde::Deserialize;

use crate::{MapWarning, YamlError};

/// How the brightness of a pixel becomes occupancy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MapMode {
    /// Occupied, free or unknown by two thresholds.
    #[default]
    Trinary,
    /// As trinary outside the thresholds, linear between them; not opaque is unknown.
    Scale,
    /// Pixels 0 to 100 are percentages, all others unknown.
    Raw,
}

/// What a map YAML says about its image.
#[derive(Debug, Clone, PartialEq)]
pub struct MapHeader {
    /// The image as the file names it; relative to the folder of the YAML.
    pub image: PathBuf,
    /// Resolution in metres and the pose of the lower-left corner of the image in the map frame.
    pub frame: GridFrame,
    /// Whether bright is occupied.
    pub negate: bool,
    /// Occupied strictly above this, in [0, 1].
    pub occupied_thresh: f64,
    /// Free strictly below this, in [0, 1].
    pub free_thresh: f64,
    /// How pixels are read.
    pub mode: MapMode,
}

impl MapHeader {
    /// The header in the bytes of a map YAML. Unknown keys are ignored.
    ///
    /// # Errors
    /// Anything but UTF-8 YAML with the keys `image`, `resolution`, `origin`, `negate`,
    /// `occupied_thresh` and `free_thresh` in their domains; a NaN yaw alone is a warning.
    pub fn parse(yaml: &[u8]) -> Result<(Self, Vec<MapWarning>), YamlError> {
        let keys = scan(yaml)?;
        let image = required(keys.image, "image", "map.pgm")?;
        if image.is_empty() {
            return Err(value_error("image", image, "a file name"));
        }
        let resolution = required(keys.resolution, "resolution", "0.05")?;
        let origin = keys
            .origin
            .ok_or(YamlError::MissingKey { key: "origin", example: "[0.0, 0.0, 0.0]" })?;
        let (frame, warnings) = frame(resolution, &origin)?;
        let occupied_thresh = threshold(keys.occupied_thresh, "occupied_thresh", "0.65")?;
        let free_thresh = threshold(keys.free_thresh, "free_thresh", "0.196")?;
        if free_thresh >= occupied_thresh {
            return Err(YamlError::Thresholds { free: free_thresh, occupied: occupied_thresh });
        }
        let header = Self {
            image: PathBuf::from(image),
            frame,
            negate: flag(required(keys.negate, "negate", "0")?)?,
            occupied_thresh,
            free_thresh,
            mode: mode(keys.mode)?,
        };
        Ok((header, warnings))
    }
}

/// Every value as the text that stands in the file, so that errors can quote it and so that
/// numbers which YAML does not know, such as `-nan`, reach our own parser.
#[derive(Deserialize)]
struct Keys {
    image: Option<String>,
    resolution: Option<String>,
    origin: Option<Vec<String>>,
    negate: Option<String>,
    occupied_thresh: Option<String>,
    free_thresh: Option<String>,
    mode: Option<String>,
}

fn scan(yaml: &[u8]) -> Result<Keys, YamlError> {
    let text = str::from_utf8(yaml).map_err(|_not_utf8| YamlError::NotText)?;
    serde_saphyr::from_str(text)
        .map_err(|error| YamlError::Syntax { message: error.without_snippet().to_string() })
}

fn required(
    value: Option<String>,
    key: &'static str,
    example: &'static str,
) -> Result<String, YamlError> {
    value.ok_or(YamlError::MissingKey { key, example })
}

fn value_error(key: &'static str, value: String, expected: &'static str) -> YamlError {
    YamlError::Value { key, value, expected }
}

fn threshold(
    value: Option<String>,
    key: &'static str,
    example: &'static str,
) -> Result<f64, YamlError> {
    let text = required(value, key, example)?;
    number(&text)
        .filter(|value| (0.0..=1.0).contains(value))
        .ok_or_else(|| value_error(key, text, "a number from 0 to 1"))
}

/// The booleans of YAML 1.1, and the integers that `map_server` writes.
fn flag(text: String) -> Result<bool, YamlError> {
    match text.to_ascii_lowercase().as_str() {
        "1" | "true" | "yes" | "on" | "y" => Ok(true),
        "0" | "false" | "no" | "off" | "n" => Ok(false),
        _ => Err(value_error("negate", text, "0 or 1")),
    }
}

fn mode(text: Option<String>) -> Result<MapMode, YamlError> {
    match text.as_deref() {
        None | Some("trinary") => Ok(MapMode::Trinary),
        Some("scale") => Ok(MapMode::Scale),
        Some("raw") => Ok(MapMode::Raw),
        Some(other) => Err(value_error("mode", other.to_owned(), "trinary, scale or raw")),
    }
}

fn frame(
    resolution_text: String,
    origin: &[String],
) -> Result<(GridFrame, Vec<MapWarning>), YamlError> {
    let Some(resolution) = number(&resolution_text) else {
        return Err(value_error("resolution", resolution_text, "a number of metres"));
    };
    let origin_text = || format!("[{}]", origin.join(", "));
    let bad = || value_error("origin", origin_text(), "[x, y, yaw], finite, in metres and radians");
    let [x_text, y_text, yaw_text] = origin else {
        return Err(bad());
    };
    let finite = |text: &str| number(text).filter(|value| value.is_finite());
    let x = finite(x_text).ok_or_else(bad)?;
    let y = finite(y_text).ok_or_else(bad)?;
    let mut warnings: Vec<MapWarning> = [('x', x, x_text), ('y', y, y_text)]
        .into_iter()
        .filter_map(|(axis, value, text)| rounded(axis, value, text))
        .collect();
    let yaw = match number(yaw_text).ok_or_else(bad)? {
        yaw if yaw.is_nan() => {
            warnings.push(MapWarning::YawNotANumber);
            0.0
        }
        yaw if yaw.is_finite() => yaw,
        _ => return Err(bad()),
    };
    let frame = GridFrame::new(resolution, Se2::new(x, y, yaw)).map_err(|cause| {
        let (key, value) = match cause {
            GridError::Resolution { .. } => ("resolution", resolution_text),
            _ => ("origin", origin_text()),
        };
        YamlError::Frame { key, value, cause }
    })?;
    Ok((frame, warnings))
}

/// A warning if a coordinate looks like the output of a saver that keeps three digits.
fn rounded(axis: char, value: f64, text: &str) -> Option<MapWarning> {
    let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
    let digits =
        mantissa.chars().filter(char::is_ascii_digit).skip_while(|&digit| digit == '0').count();
    (value.abs() >= 100.0 && digits <= 3).then(|| MapWarning::RoundedOrigin {
        axis,
        text: text.to_owned(),
        error: 0.5 * 10_f64.powf(value.abs().log10().floor() - 2.0),
    })
}

/// A number as C, C++ or YAML prints it, NaN and infinities included.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let word = unsigned.trim_start_matches('.').to_ascii_lowercase();
    if word.starts_with("nan") {
        Some(f64::NAN)
    } else if word == "inf" {
        Some(f64::INFINITY)
    } else {
        None
    }
}
