//! Maps as they are handed in.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use ogm_core::OccupancyGrid;
use ogm_io::{IoError, LoadedMap, ReadOptions, YamlError};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::progress::Wheel;
use crate::reading::ReadingArgs;
use crate::terminal;

/// Which map a report is about.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct MapFile {
    /// The YAML, as it was named.
    pub(crate) file: String,
    /// Of the image file that the YAML names, as `sha256sum` prints it.
    pub(crate) sha256: String,
}

/// A map and where it came from.
#[derive(Debug)]
pub(crate) struct Input {
    pub(crate) yaml: PathBuf,
    pub(crate) loaded: LoadedMap,
    pub(crate) sha256: String,
}

impl Input {
    /// Reads a map; says what is suspicious about it unless `quiet`.
    pub(crate) fn read(yaml: &Path, reading: &ReadingArgs, quiet: bool) -> anyhow::Result<Self> {
        let input = {
            let _progress = Wheel::start("reading", quiet);
            Self::read_silently(yaml, reading)?
        };
        input.warn(quiet);
        Ok(input)
    }

    /// Reads maps on all cores; says what is suspicious about them unless `quiet`.
    pub(crate) fn read_all(
        yamls: &[&Path],
        reading: &ReadingArgs,
        quiet: bool,
    ) -> anyhow::Result<Vec<Self>> {
        let inputs: Vec<anyhow::Result<Self>> = {
            let _progress = Wheel::start("reading", quiet);
            yamls.par_iter().map(|yaml| Self::read_silently(yaml, reading)).collect()
        };
        let warned = inputs.into_iter().map(|input| input.inspect(|input| input.warn(quiet)));
        warned.collect()
    }

    fn warn(&self, quiet: bool) {
        if !quiet {
            for warning in &self.loaded.warnings {
                terminal::warning(&format!("{}: {warning}", self.yaml.display()));
            }
        }
    }

    /// Reads a map.
    pub(crate) fn read_silently(yaml: &Path, reading: &ReadingArgs) -> anyhow::Result<Self> {
        let files = reading.files(yaml).map_err(with_remedy)?;
        let sha256 = sha256(files.image_bytes());
        let loaded = files.decode(&ReadOptions::default())?;
        Ok(Self { yaml: yaml.to_owned(), loaded, sha256 })
    }

    pub(crate) fn map(&self) -> &OccupancyGrid {
        &self.loaded.map
    }

    pub(crate) fn name(&self) -> String {
        self.yaml.display().to_string()
    }

    pub(crate) fn file(&self) -> MapFile {
        MapFile { file: self.name(), sha256: self.sha256.clone() }
    }

    /// The files that it was read from.
    pub(crate) fn paths(&self) -> [&Path; 2] {
        [&self.yaml, &self.loaded.image]
    }
}

/// Says how an image is read that has no YAML.
fn with_remedy(error: IoError) -> anyhow::Error {
    let IoError::Yaml { path, cause: YamlError::Image } = &error else {
        return error.into();
    };
    let image = path.display();
    let yaml = path.with_extension("yaml");
    let beside = if yaml.is_file() {
        format!("name its YAML, {}", yaml.display())
    } else {
        "name its YAML".to_owned()
    };
    anyhow!(
        "{image} is an image: {beside}, or say how many metres a cell has: --input {image}=0.05"
    )
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
