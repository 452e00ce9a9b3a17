//! Where an output really goes.

use std::fs;
use std::io::{self, Error, ErrorKind};
use std::path::{Path, PathBuf};

use crate::bounded::kind;

/// What is behind the name of an output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Target {
    /// A regular file or none yet; links are followed, so that they stay links.
    File(PathBuf),
    /// A device, or a stream that this process was given, which takes bytes and is never replaced.
    Device,
}

impl Target {
    /// # Errors
    /// A folder, a pipe or a socket; links that lead in a circle.
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        // Its other end is open already, so that opening it cannot wait.
        if path.starts_with("/dev/fd") || path.starts_with("/proc/self/fd") {
            return Ok(Self::Device);
        }
        let place = followed(path)?;
        match fs::metadata(&place) {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Self::File(place)),
            Err(error) => Err(error),
            Ok(metadata) if metadata.is_file() => Ok(Self::File(place)),
            Ok(metadata) if metadata.is_dir() => Err(ErrorKind::IsADirectory.into()),
            Ok(metadata) => match kind(&metadata) {
                "a device" => Ok(Self::Device),
                kind => {
                    let message = format!("it is {kind}; name a file, or `-` for standard output");
                    Err(Error::new(ErrorKind::InvalidInput, message))
                }
            },
        }
    }

    /// # Errors
    /// Anything but a regular file or none yet.
    pub(crate) fn file(path: &Path) -> io::Result<PathBuf> {
        match Self::of(path)? {
            Self::File(place) => Ok(place),
            Self::Device => {
                Err(Error::new(ErrorKind::InvalidInput, "it is a device; a map is two files"))
            }
        }
    }
}

/// The end of a chain of symbolic links, which need not exist.
fn followed(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&place) {
            Ok(next) => place = place.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(place),
        }
    }
    Err(Error::other("its links lead in a circle"))
}
