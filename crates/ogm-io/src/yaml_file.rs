//! The YAML file of a map, which may be replaced while its image is read.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use crate::bounded::read_at_most;
use crate::format::Format;
use crate::{IoError, YamlError};

/// A map YAML has seven keys; 64 KiB of them are something else.
const MAX_YAML_BYTES: u64 = 1 << 16;
/// Enough to tell an image.
const HEAD_BYTES: u64 = 16;

/// What a YAML says, and the file itself: as long as it is open no other can be taken for it.
///
/// A writer that comes back to what the YAML said before cannot be told by the text.
pub(crate) struct HeldYaml {
    pub(crate) text: Vec<u8>,
    file: File,
}

impl HeldYaml {
    pub(crate) fn read(yaml: &Path) -> Result<Self, IoError> {
        let text = read_yaml(yaml)?;
        let file = File::open(yaml).map_err(|cause| access(yaml, cause))?;
        Ok(Self { text, file })
    }

    /// Whether it is the same file, unchanged.
    pub(crate) fn is(&self, other: &Self) -> bool {
        self.text == other.text && is_same_file(&self.file, &other.file)
    }
}

#[cfg(unix)]
fn is_same_file(a: &File, b: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |file: &File| file.metadata().map(|found| (found.dev(), found.ino())).ok();
    identity(a).is_some_and(|of_a| identity(b) == Some(of_a))
}

/// Elsewhere a file has no number that holds; the text has to do.
#[cfg(not(unix))]
fn is_same_file(_: &File, _: &File) -> bool {
    true
}

pub(crate) fn read_yaml(yaml: &Path) -> Result<Vec<u8>, IoError> {
    let too_large = match read_at_most(yaml, MAX_YAML_BYTES) {
        Err(cause) if cause.kind() == ErrorKind::FileTooLarge => cause,
        read => return read.map_err(|cause| access(yaml, cause)),
    };
    let mut head = Vec::new();
    let file = File::open(yaml).and_then(|file| file.take(HEAD_BYTES).read_to_end(&mut head));
    match file {
        Ok(_) if Format::of(&head).is_some() => {
            Err(IoError::Yaml { path: yaml.to_owned(), cause: YamlError::Image })
        }
        _ => Err(access(yaml, too_large)),
    }
}

pub(crate) fn access(path: &Path, cause: io::Error) -> IoError {
    IoError::Access { path: path.to_owned(), action: "read", cause }
}

#[cfg(all(test, unix))]
mod tests {
    use super::HeldYaml;
    use std::fs;

    #[test]
    fn a_yaml_that_was_replaced_by_its_like_is_another() {
        let folder = tempfile::tempdir().unwrap();
        let [yaml, next] = ["map.yaml", "next"].map(|name| folder.path().join(name));
        fs::write(&yaml, "resolution: 0.05\n").unwrap();
        let held = HeldYaml::read(&yaml).unwrap();
        assert!(held.is(&HeldYaml::read(&yaml).unwrap()));
        fs::remove_file(&yaml).unwrap();
        fs::write(&next, "resolution: 0.05\n").unwrap();
        fs::rename(&next, &yaml).unwrap();
        assert!(!held.is(&HeldYaml::read(&yaml).unwrap()));
    }
}
