//! Writing a map: an image, then the YAML that names it.

use std::fs;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

use ogm_core::{CellClass, ClassThresholds, Occupancy, OccupancyGrid};

use crate::classify::{FREE_GREY, OCCUPIED_GREY, UNKNOWN_GREY};
use crate::disk::{Temporary, put_pair_in_place};
use crate::{IoError, MapImageError, png, pnm};

/// What is kept of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CellEncoding {
    /// Its class, as a PGM of 0 (p ≥ 0.65), 254 (p ≤ 0.35) and 205 (all else), mode `trinary`,
    /// thresholds 0.65 and 0.196: what every reader understands.
    #[default]
    Classes,
    /// Its probability, as a PNG of grey levels in which unknown is transparent, mode `scale`,
    /// thresholds 1 and 0. Reading it back gives the same map bit for bit.
    Probabilities,
}

/// How a map is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct WriteOptions {
    /// Replace existing files.
    pub overwrite: bool,
    /// What is kept of a cell.
    pub encoding: CellEncoding,
}

/// Writes `map` as the YAML file `yaml` and an image of the same name, `.pgm` or `.png`, beside it.
///
/// Both are complete on the disk under temporary names before either has its own. An existing YAML
/// is moved away before the new image takes its name, and the new YAML comes last, so a kill leaves
/// the old pair, the new pair, or no YAML. The origin is written with its yaw, to the last digit.
///
/// # Errors
/// A file that exists unless `options.overwrite`; a folder that cannot be written; a file name that
/// is not UTF-8 or ends in the image's extension. The old pair is then as it was, unless the very
/// last renaming failed.
pub fn write_map(yaml: &Path, map: &OccupancyGrid, options: &WriteOptions) -> Result<(), IoError> {
    let extension = match options.encoding {
        CellEncoding::Classes => "pgm",
        CellEncoding::Probabilities => "png",
    };
    let image = yaml.with_extension(extension);
    let image_name = plain_file_name(yaml, &image)?;
    for target in [yaml, &image] {
        check_target(target, options.overwrite)?;
    }
    let bytes = encode(map, options.encoding)
        .map_err(|cause| IoError::Image { path: image.clone(), cause })?;
    let text = yaml_text(map, options.encoding, &image_name);
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |cause| access(path, cause)
    };
    let new_image = Temporary::write(&image, &bytes).map_err(failed(&image))?;
    let new_yaml = Temporary::write(yaml, text.as_bytes()).map_err(failed(yaml))?;
    put_pair_in_place(&new_image, &new_yaml).map_err(failed(yaml))
}

/// The file name of the image, if it can stand in a YAML and is not that of the YAML itself.
fn plain_file_name(yaml: &Path, image: &Path) -> Result<String, IoError> {
    let refuse = |message| {
        let cause = Error::new(ErrorKind::InvalidInput, message);
        Err(access(yaml.to_owned(), cause))
    };
    let is_image =
        |extension: &str| ["pgm", "png"].iter().any(|image| extension.eq_ignore_ascii_case(image));
    if yaml.extension().is_some_and(|extension| extension.to_str().is_some_and(is_image)) {
        return refuse("name the map's .yaml; its image goes beside it");
    }
    match image.file_name().map(|name| name.to_str()) {
        Some(Some(name)) if !name.contains(char::is_control) => Ok(name.to_owned()),
        Some(_) => refuse("a map YAML can name its image only if the name is plain UTF-8"),
        None => refuse("not a file name"),
    }
}

fn check_target(target: &Path, overwrite: bool) -> Result<(), IoError> {
    match fs::symlink_metadata(target) {
        Err(_) => Ok(()),
        Ok(_) if !overwrite => Err(IoError::Exists { path: target.to_owned() }),
        Ok(metadata) if metadata.is_dir() => {
            let cause = Error::from(ErrorKind::IsADirectory);
            Err(access(target.to_owned(), cause))
        }
        Ok(_) => Ok(()),
    }
}

fn access(path: PathBuf, cause: Error) -> IoError {
    IoError::Access { path, action: "write", cause }
}

fn encode(map: &OccupancyGrid, encoding: CellEncoding) -> Result<Vec<u8>, MapImageError> {
    let cells = map.cells().rows().rev().flatten();
    match encoding {
        CellEncoding::Classes => {
            let thresholds = ClassThresholds::default();
            let levels: Vec<u8> = cells
                .map(|&cell| match thresholds.classify(cell) {
                    CellClass::Occupied => OCCUPIED_GREY,
                    CellClass::Free => FREE_GREY,
                    CellClass::Undecided | CellClass::Unknown => UNKNOWN_GREY,
                })
                .collect();
            let mut file = pnm::grey_header(map.width(), map.height()).into_bytes();
            file.extend(levels);
            Ok(file)
        }
        CellEncoding::Probabilities => {
            let pairs: Vec<u8> = cells.flat_map(|&cell| grey_and_alpha(cell)).collect();
            png::encode_grey_alpha(map.width(), map.height(), &pairs)
        }
    }
}

/// Black is p = 1. The 255 steps of p take 255 of the 256 greys, so each has its own.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "p is in [0, 1]")]
fn grey_and_alpha(cell: Occupancy) -> [u8; 2] {
    match cell.probability() {
        Some(p) => [255 - (p * 255.0).round() as u8, 255],
        None => [UNKNOWN_GREY, 0],
    }
}

fn yaml_text(map: &OccupancyGrid, encoding: CellEncoding, image: &str) -> String {
    let (mode, occupied, free) = match encoding {
        CellEncoding::Classes => ("trinary", "0.65", "0.196"),
        CellEncoding::Probabilities => ("scale", "1.0", "0.0"),
    };
    let map_from_grid = map.frame().map_from_grid();
    format!(
        "image: {}\nmode: {mode}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\n\
         occupied_thresh: {occupied}\nfree_thresh: {free}\n",
        quoted(image),
        decimal(map.frame().resolution()),
        decimal(map_from_grid.x()),
        decimal(map_from_grid.y()),
        decimal(map_from_grid.theta()),
    )
}

/// Every digit that tells a float from its neighbours, and no exponent: `1e-7` is a number to
/// C++ and a word to YAML 1.1.
fn decimal(value: f64) -> String {
    // Adding zero turns -0.0 into 0.0.
    let text = format!("{}", value + 0.0);
    if text.contains('.') { text } else { text + ".0" }
}

/// A file name as YAML, quoted where it could be taken for something else.
fn quoted(name: &str) -> String {
    let harmless = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(harmless) {
        name.to_owned()
    } else {
        format!("'{}'", name.replace('\'', "''"))
    }
}
