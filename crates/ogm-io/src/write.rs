//! Writing a map: an image, then the YAML that names it.

use std::fs;
use std::io::{self, Error, ErrorKind};
use std::path::{Path, PathBuf};

use ogm_core::{Cancelled, CellClass, ClassThresholds, Occupancy, OccupancyGrid, Progress};

use crate::classify::{FREE_GREY, OCCUPIED_GREY, UNKNOWN_GREY};
use crate::lock::{NameLock, is_locked};
use crate::target::Target;
use crate::temporary::{Temporary, is_left, put_pair_in_place, recover_pair};
use crate::{IoError, png, pnm};

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

/// A map that is complete on the disk under temporary names, and the right to put it in place.
///
/// Dropped, it leaves what was there as it was.
#[derive(Debug)]
pub struct StagedMap {
    path: PathBuf,
    image: Temporary,
    yaml: Temporary,
    /// Let go of last.
    _locks: [NameLock; 2],
}

impl StagedMap {
    /// Writes `map` beside where the YAML file `yaml` and an image of the same name, `.pgm` or
    /// `.png`, are to be.
    ///
    /// One writer at a time: whoever finds another at work on these names waits for it. What a
    /// killed writer left of them is cleared up first, as by [`recover_map`]. The origin is written
    /// with its yaw, to the last digit.
    ///
    /// # Errors
    /// A file that exists unless `options.overwrite`; a folder that cannot be written; a file name
    /// that is not UTF-8 or ends in the image's extension; a device, pipe or socket; another writer
    /// that does not end; cancelled.
    pub fn write(
        yaml: &Path,
        map: &OccupancyGrid,
        options: &WriteOptions,
        progress: &dyn Progress,
    ) -> Result<Self, IoError> {
        let image = yaml.with_extension(options.encoding.extension());
        let image_name = plain_file_name(yaml, &image)?;
        let yaml_file = Target::file(yaml).map_err(failed(yaml))?;
        let image_file = Target::file(&image).map_err(failed(&image))?;
        let yaml_lock = NameLock::wait(&yaml_file, progress).map_err(failed(yaml))?;
        let image_lock = NameLock::wait(&image_file, progress).map_err(failed(&image))?;
        let (Some(yaml_lock), Some(image_lock)) = (yaml_lock, image_lock) else {
            return Err(Cancelled.into());
        };
        recover_pair(&image_file, &yaml_file).map_err(failed(yaml))?;
        for target in [yaml, &image] {
            if !options.overwrite && fs::symlink_metadata(target).is_ok() {
                return Err(IoError::Exists { path: target.to_owned() });
            }
        }
        let new_image = written_image(&image_file, map, options.encoding, progress);
        if progress.is_cancelled() {
            return Err(Cancelled.into());
        }
        let text = yaml_text(map, options.encoding, &image_name);
        let new_yaml = Temporary::write(&yaml_file, |file| file.write_all(text.as_bytes()));
        Ok(Self {
            path: yaml.to_owned(),
            image: new_image.map_err(failed(&image))?,
            yaml: new_yaml.map_err(failed(yaml))?,
            _locks: [yaml_lock, image_lock],
        })
    }

    /// Gives both files their names, replacing what has them.
    ///
    /// An existing YAML is moved away before the new image takes its name, and the new YAML comes
    /// last, so a kill leaves the old pair, the new pair, or no YAML; of the last, the next writing
    /// of this name makes a whole pair. Existing files keep their permissions, symbolic links stay
    /// links.
    ///
    /// # Errors
    /// A name that cannot be taken. The old pair is then as it was, unless it was the YAML's.
    pub fn put_in_place(self) -> Result<(), IoError> {
        put_pair_in_place(&self.image, &self.yaml).map_err(failed(&self.path))
    }
}

/// Writes `map` as the YAML file `yaml` and an image of the same name, `.pgm` or `.png`, beside it.
///
/// # Errors
/// As [`StagedMap::write`] and [`StagedMap::put_in_place`].
pub fn write_map(yaml: &Path, map: &OccupancyGrid, options: &WriteOptions) -> Result<(), IoError> {
    StagedMap::write(yaml, map, options, &())?.put_in_place()
}

/// Makes a whole pair of what a killed writer left at the name `yaml`, and removes its temporary
/// files; where nothing is left, nothing is touched.
///
/// # Errors
/// A folder that cannot be written. That another writer is at work is none.
pub fn recover_map(yaml: &Path) -> Result<(), IoError> {
    let Ok(yaml_file) = Target::file(yaml) else { return Ok(()) };
    for extension in ["pgm", "png"] {
        let Ok(image_file) = Target::file(&yaml.with_extension(extension)) else { continue };
        if ![&yaml_file, &image_file].into_iter().any(|file| is_left(file) || is_locked(file)) {
            continue;
        }
        let locks = [&yaml_file, &image_file].map(|file| NameLock::attempt(file));
        if let [Ok(Some(_)), Ok(Some(_))] = &locks {
            recover_pair(&image_file, &yaml_file).map_err(failed(yaml))?;
        }
    }
    Ok(())
}

fn failed(path: &Path) -> impl FnOnce(Error) -> IoError {
    let path = path.to_owned();
    move |cause| access(path, cause)
}

impl CellEncoding {
    fn extension(self) -> &'static str {
        match self {
            Self::Classes => "pgm",
            Self::Probabilities => "png",
        }
    }
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

fn access(path: PathBuf, cause: Error) -> IoError {
    IoError::Access { path, action: "write", cause }
}

/// The image of `map` under a temporary name, written row by row.
fn written_image(
    target: &Path,
    map: &OccupancyGrid,
    encoding: CellEncoding,
    progress: &dyn Progress,
) -> io::Result<Temporary> {
    let (width, height) = (map.width(), map.height());
    let rows = map.cells().rows().rev();
    Temporary::write(target, |file| match encoding {
        CellEncoding::Classes => {
            file.write_all(pnm::grey_header(width, height).as_bytes())?;
            let mut grey_of = [UNKNOWN_GREY; 256];
            let thresholds = ClassThresholds::default();
            for (byte, grey) in (0..=u8::MAX).zip(&mut grey_of) {
                *grey = match thresholds.classify(Occupancy::from_byte(byte)) {
                    CellClass::Occupied => OCCUPIED_GREY,
                    CellClass::Free => FREE_GREY,
                    CellClass::Undecided | CellClass::Unknown => UNKNOWN_GREY,
                };
            }
            let mut greys = Vec::with_capacity(width);
            for (done, row) in rows.enumerate() {
                if progress.is_cancelled() {
                    return Err(ErrorKind::Interrupted.into());
                }
                progress.report(done as f64 / height as f64);
                greys.clear();
                greys.extend(row.iter().map(|cell| grey_of[usize::from(cell.byte())]));
                file.write_all(&greys)?;
            }
            Ok(())
        }
        CellEncoding::Probabilities => {
            let pairs: Vec<u8> = rows.flatten().flat_map(|&cell| grey_and_alpha(cell)).collect();
            let bytes = png::encode_grey_alpha(width, height, &pairs).map_err(Error::other)?;
            file.write_all(&bytes)
        }
    })
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
