//! Files that are about to be written, and the writing.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use ogm_core::OccupancyGrid;
use ogm_io::{StagedMap, WriteOptions, recover_map, write_file};

use crate::interrupt::Listening;
use crate::progress::Bar;
use crate::usage::UsageError;

/// What standard output is called on a command line.
const STANDARD_OUTPUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// Endings of maps.
const MAPS: [&str; 2] = ["yaml", "yml"];

/// Endings of files that are something else than what is written.
const PICTURES: [&str; 11] =
    ["pgm", "png", "ppm", "pbm", "bmp", "jpg", "jpeg", "gif", "tif", "tiff", "webp"];
const TEXTS: [&str; 6] = ["json", "csv", "txt", "html", "svg", "pdf"];

/// Makes sure before the work that `outputs` can be meant: their folders exist, none is an input,
/// and none exists unless `force`. What a killed run left at a map's name is cleared up.
pub(crate) fn check(outputs: &[&Path], inputs: &[&Path], force: bool) -> anyhow::Result<()> {
    let inputs: Vec<PathBuf> =
        inputs.iter().filter_map(|input| input.canonicalize().ok()).collect();
    let mut places: Vec<PathBuf> = Vec::new();
    for output in outputs {
        let name = output.display();
        let place = place(output)?;
        if has_ending(output, &MAPS) {
            recover_map(output)?;
        }
        let target = output.canonicalize().unwrap_or_else(|_| place.clone());
        if inputs.contains(&place) || inputs.contains(&target) {
            bail!("{name} is an input and is never overwritten; name another output");
        }
        // A map that is named as its own image is refused by its name.
        if places.contains(&place) && !has_ending(outputs[0], &PICTURES) {
            bail!("{name} is named for two outputs; name another");
        }
        let is_replaced = match output.metadata() {
            Ok(there) => there.is_file() || there.is_dir(),
            Err(_) => output.symlink_metadata().is_ok(),
        };
        if !force && is_replaced && !is_standard(output) {
            bail!("{name} exists; name another output or overwrite it with --force");
        }
        places.push(place);
    }
    Ok(())
}

/// The file name in its folder, links of the folder resolved.
fn place(output: &Path) -> anyhow::Result<PathBuf> {
    if is_standard(output) {
        return Ok(PathBuf::from(STANDARD_OUTPUT[0]));
    }
    let name = output.display();
    let file = output.file_name().with_context(|| format!("{name} is not a file name"))?;
    let folder = match output.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let folder = folder.canonicalize().with_context(|| {
        format!("cannot write {name}: the folder {} cannot be used", folder.display())
    })?;
    if let Err(error) = output.symlink_metadata()
        && error.kind() == std::io::ErrorKind::InvalidFilename
    {
        return Err(error).with_context(|| format!("cannot write {name}"));
    }
    Ok(folder.join(file))
}

/// Makes sure that `yaml` can be the name of a map.
pub(crate) fn check_map(yaml: &Path) -> Result<(), UsageError> {
    let name = yaml.display();
    if is_standard(yaml) {
        let message = format!("-o {name}: a map is two files; name its .yaml");
        return Err(UsageError(message));
    }
    if !has_ending(yaml, &MAPS) {
        let proper =
            if has_ending(yaml, &PICTURES) { yaml.with_extension("yaml") } else { added(yaml) };
        let message = format!(
            "-o {name}: name the map's .yaml, its image goes beside it: -o {}",
            proper.display()
        );
        return Err(UsageError(message));
    }
    Ok(())
}

/// Makes sure that `output` can be the name of a merged map, a bag being one.
pub(crate) fn check_merged(output: &Path) -> Result<(), UsageError> {
    if !is_bag(output) {
        return check_map(output);
    }
    if cfg!(feature = "bags") {
        return Ok(());
    }
    let message = format!(
        "-o {}: this build writes no bags; name a .yaml, or build with --features bags",
        output.display()
    );
    Err(UsageError(message))
}

/// Whether an output is a bag by its name.
pub(crate) fn is_bag(output: &Path) -> bool {
    has_ending(output, &["mcap"])
}

fn added(path: &Path) -> PathBuf {
    if path.is_dir() || path.file_name().is_none() {
        return path.join("map.yaml");
    }
    let mut name = path.as_os_str().to_owned();
    name.push(".yaml");
    PathBuf::from(name)
}

/// Makes sure that `picture` is not named as something else than a PNG.
pub(crate) fn check_picture(picture: &Path) -> Result<(), UsageError> {
    let is_other = !has_ending(picture, &["png"])
        && [&MAPS[..], &PICTURES, &TEXTS].iter().any(|endings| has_ending(picture, endings));
    if is_other {
        let (name, proper) = (picture.display(), picture.with_extension("png"));
        let message = format!("{name}: pictures are written as PNG; name it {}", proper.display());
        return Err(UsageError(message));
    }
    if is_standard(picture) && std::io::stdout().is_terminal() {
        return Err(UsageError("a picture is nothing for a terminal; redirect it".to_owned()));
    }
    Ok(())
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// The image that goes beside the map `yaml`.
pub(crate) fn image_of(yaml: &Path) -> PathBuf {
    yaml.with_extension("pgm")
}

/// Whether an output goes to standard output.
pub(crate) fn is_standard(output: &Path) -> bool {
    STANDARD_OUTPUT.iter().any(|name| output == Path::new(name))
}

/// Writes an output that is no map, at once or not at all.
pub(crate) fn write(output: &Path, bytes: &[u8], force: bool) -> anyhow::Result<()> {
    // The end of a short writing is waited for.
    let _listening = Listening::start();
    if is_standard(output) {
        let mut stdout = std::io::stdout().lock();
        let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
        return written.context("cannot write to standard output");
    }
    Ok(write_file(output, bytes, force)?)
}

/// A map that lies ready to be put in place, and Ctrl-C held back until it is.
#[derive(Debug)]
pub(crate) struct Staged {
    output: Lying,
    _bar: Bar,
}

#[derive(Debug)]
enum Lying {
    Map(StagedMap),
    /// In memory: it is one file, and small.
    #[cfg(feature = "bags")]
    Bag {
        path: PathBuf,
        bytes: Vec<u8>,
        force: bool,
    },
}

impl Staged {
    /// Writes `map` under temporary names; Ctrl-C ends it.
    pub(crate) fn write(
        yaml: &Path,
        map: &OccupancyGrid,
        force: bool,
        quiet: bool,
    ) -> anyhow::Result<Self> {
        let options = WriteOptions { overwrite: force, ..WriteOptions::default() };
        let bar = Bar::start("writing", quiet);
        let map = StagedMap::write(yaml, map, &options, &bar)?;
        Ok(Self { output: Lying::Map(map), _bar: bar })
    }

    /// Holds the bytes of a bag.
    #[cfg(feature = "bags")]
    pub(crate) fn bag(path: &Path, bytes: Vec<u8>, force: bool, quiet: bool) -> Self {
        let path = path.to_owned();
        Self { output: Lying::Bag { path, bytes, force }, _bar: Bar::start("writing", quiet) }
    }

    pub(crate) fn put_in_place(self) -> anyhow::Result<()> {
        match self.output {
            Lying::Map(map) => map.put_in_place()?,
            #[cfg(feature = "bags")]
            Lying::Bag { path, bytes, force } => write_file(&path, &bytes, force)?,
        }
        Ok(())
    }
}
