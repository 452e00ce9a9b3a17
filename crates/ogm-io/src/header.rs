//! The YAML half of a map, as ROS `map_server` defines it.

use std::path::PathBuf;

use ogm_core::{GridError, GridFrame, Se2};

use crate::entries::{self, Entry, Value};
use crate::format::Format;
use crate::lfs::is_lfs_pointer;
use crate::text::{self, TextEncoding};
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
    /// The header in the bytes of a map YAML: UTF-8, UTF-16 or Latin-1, as yaml-cpp takes them.
    /// Unknown keys are ignored.
    ///
    /// # Errors
    /// Anything but a YAML mapping with the keys `image`, `resolution`, `origin`, `negate`,
    /// `occupied_thresh` and `free_thresh` in their domains. A NaN yaw, a key that stands twice
    /// (the last counts) and a `mode` that is no scalar (trinary) are warnings.
    pub fn parse(yaml: &[u8]) -> Result<(Self, Vec<MapWarning>), YamlError> {
        if is_lfs_pointer(yaml) {
            return Err(YamlError::LfsPointer);
        }
        if Format::of(yaml).is_some() {
            return Err(YamlError::Image);
        }
        let (text, encoding) = text::decode(yaml).ok_or(YamlError::NotText)?;
        let entries = entries::parse(&text).map_err(|message| YamlError::Syntax { message })?;
        let (keys, mut warnings) = Keys::of(entries);
        if encoding != TextEncoding::Utf8 {
            warnings.push(MapWarning::Encoding { encoding });
        }
        let image = scalar(keys.image, "image", "map.pgm", "a file name")?;
        if image.is_empty() {
            return Err(value_error("image", image, "a file name"));
        }
        let resolution = scalar(keys.resolution, "resolution", "0.05", METRES)?;
        let (frame, noticed) = frame(resolution, keys.origin)?;
        warnings.extend(noticed);
        let occupied_thresh = threshold(keys.occupied_thresh, "occupied_thresh", "0.65")?;
        let free_thresh = threshold(keys.free_thresh, "free_thresh", "0.196")?;
        if free_thresh >= occupied_thresh {
            return Err(YamlError::Thresholds { free: free_thresh, occupied: occupied_thresh });
        }
        let header = Self {
            image: file_name(image, encoding),
            frame,
            negate: flag(scalar(keys.negate, "negate", "0", "0 or 1")?)?,
            occupied_thresh,
            free_thresh,
            mode: mode(keys.mode, &mut warnings)?,
        };
        Ok((header, warnings))
    }

    /// The header of an image that has no YAML: trinary, with the thresholds of `map_saver`.
    pub(crate) fn without_yaml(image: PathBuf, frame: GridFrame) -> Self {
        let mode = MapMode::Trinary;
        Self { image, frame, negate: false, occupied_thresh: 0.65, free_thresh: 0.196, mode }
    }
}

const METRES: &str = "a number of metres";

/// The values of the keys that are known.
#[derive(Debug, Default)]
struct Keys {
    image: Option<Value>,
    resolution: Option<Value>,
    origin: Option<Value>,
    negate: Option<Value>,
    occupied_thresh: Option<Value>,
    free_thresh: Option<Value>,
    mode: Option<Value>,
}

impl Keys {
    /// The last value of each key, and which keys stand more than once.
    fn of(entries: Vec<Entry>) -> (Self, Vec<MapWarning>) {
        let mut keys = Self::default();
        let mut warnings = Vec::new();
        for Entry { key, value } in entries {
            let (name, slot) = match key.as_str() {
                "image" => ("image", &mut keys.image),
                "resolution" => ("resolution", &mut keys.resolution),
                "origin" => ("origin", &mut keys.origin),
                "negate" => ("negate", &mut keys.negate),
                "occupied_thresh" => ("occupied_thresh", &mut keys.occupied_thresh),
                "free_thresh" => ("free_thresh", &mut keys.free_thresh),
                "mode" => ("mode", &mut keys.mode),
                _ => continue,
            };
            if let Some(first) = slot {
                let (first, last) = (written(first), written(&value));
                warnings.push(MapWarning::DuplicateKey { key: name, first, last });
            }
            *slot = Some(value);
        }
        (keys, warnings)
    }
}

/// The file name as the file has it: in Latin-1 its bytes, where paths are bytes.
fn file_name(image: String, encoding: TextEncoding) -> PathBuf {
    #[cfg(unix)]
    if encoding == TextEncoding::Latin1 {
        use std::os::unix::ffi::OsStringExt;
        let bytes = image.chars().filter_map(|c| u8::try_from(c).ok()).collect();
        return PathBuf::from(std::ffi::OsString::from_vec(bytes));
    }
    let _ = encoding;
    PathBuf::from(image)
}

/// A value as text, whatever its shape.
fn written(value: &Value) -> String {
    match value {
        Value::Null => "nothing".to_owned(),
        Value::Scalar(text) => text.clone(),
        Value::List(items) => format!("[{}]", items.join(", ")),
        Value::Other(shape) => (*shape).to_owned(),
    }
}

fn scalar(
    value: Option<Value>,
    key: &'static str,
    example: &'static str,
    expected: &'static str,
) -> Result<String, YamlError> {
    match value {
        None | Some(Value::Null) => Err(YamlError::MissingKey { key, example }),
        Some(Value::Scalar(text)) => Ok(text),
        Some(other) => Err(value_error(key, written(&other), expected)),
    }
}

fn value_error(key: &'static str, value: String, expected: &'static str) -> YamlError {
    YamlError::Value { key, value, expected }
}

fn threshold(
    value: Option<Value>,
    key: &'static str,
    example: &'static str,
) -> Result<f64, YamlError> {
    const EXPECTED: &str = "a number from 0 to 1";
    let text = scalar(value, key, example, EXPECTED)?;
    number(&text)
        .filter(|value| (0.0..=1.0).contains(value))
        .ok_or_else(|| value_error(key, text, EXPECTED))
}

/// The booleans of YAML 1.1, and the integers that `map_server` writes.
fn flag(text: String) -> Result<bool, YamlError> {
    match text.to_ascii_lowercase().as_str() {
        "1" | "true" | "yes" | "on" | "y" => Ok(true),
        "0" | "false" | "no" | "off" | "n" => Ok(false),
        _ => Err(value_error("negate", text, "0 or 1")),
    }
}

/// What is no scalar is trinary, as in ROS 1; another word than the three is an error everywhere.
fn mode(value: Option<Value>, warnings: &mut Vec<MapWarning>) -> Result<MapMode, YamlError> {
    match value {
        None | Some(Value::Null) => Ok(MapMode::Trinary),
        Some(Value::Scalar(text)) => match text.as_str() {
            "trinary" => Ok(MapMode::Trinary),
            "scale" => Ok(MapMode::Scale),
            "raw" => Ok(MapMode::Raw),
            _ => Err(value_error("mode", text, "trinary, scale or raw")),
        },
        Some(other) => {
            warnings.push(MapWarning::ModeNotAWord { value: written(&other) });
            Ok(MapMode::Trinary)
        }
    }
}

fn frame(
    resolution_text: String,
    origin: Option<Value>,
) -> Result<(GridFrame, Vec<MapWarning>), YamlError> {
    let Some(resolution) = number(&resolution_text) else {
        return Err(value_error("resolution", resolution_text, METRES));
    };
    let origin = match origin {
        None | Some(Value::Null) => {
            return Err(YamlError::MissingKey { key: "origin", example: "[0.0, 0.0, 0.0]" });
        }
        Some(value) => value,
    };
    let bad =
        || value_error("origin", written(&origin), "[x, y, yaw], finite, in metres and radians");
    let Value::List(items) = &origin else {
        return Err(bad());
    };
    let [x_text, y_text, yaw_text] = &items[..] else {
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
            _ => ("origin", written(&origin)),
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
