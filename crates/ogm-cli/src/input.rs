//! Maps as they are handed in.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Context;
use ogm_core::OccupancyGrid;
use ogm_io::{LoadedMap, read_map};
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::progress::Wheel;
use crate::terminal;

/// Which map a report is about.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
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
    pub(crate) fn read(yaml: &Path, quiet: bool) -> anyhow::Result<Self> {
        let input = {
            let _progress = Wheel::start("reading", quiet);
            Self::read_silently(yaml)?
        };
        if !quiet {
            for warning in &input.loaded.warnings {
                terminal::warning(&format!("{}: {warning}", yaml.display()));
            }
        }
        Ok(input)
    }

    /// Reads a map.
    pub(crate) fn read_silently(yaml: &Path) -> anyhow::Result<Self> {
        let loaded = read_map(yaml)?;
        let sha256 = sha256(&loaded.image)
            .with_context(|| format!("cannot read {}", loaded.image.display()))?;
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

fn sha256(path: &Path) -> io::Result<String> {
    let mut hash = Hasher(Sha256::new());
    io::copy(&mut File::open(path)?, &mut hash)?;
    Ok(hash.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

struct Hasher(Sha256);

impl io::Write for Hasher {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
