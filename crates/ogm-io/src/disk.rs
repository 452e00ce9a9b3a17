//! Bounded reads and atomic writes.

use std::ffi::OsString;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use crate::IoError;

/// The bytes of a regular file of at most `limit` bytes; what is no file is not even opened.
pub(crate) fn read_at_most(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        let message = format!("it is {}, not a regular file; save it as one", kind(&metadata));
        return Err(io::Error::new(ErrorKind::InvalidInput, message));
    }
    let mut bytes = Vec::new();
    let expected = usize::try_from(metadata.len().min(limit)).unwrap_or(usize::MAX);
    // One more, so that the end is seen without growing.
    bytes.try_reserve_exact(expected.saturating_add(1))?;
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        let message = format!("larger than {limit} bytes, the most that such a file may have");
        return Err(io::Error::new(ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// What a path is that is no regular file.
fn kind(metadata: &Metadata) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = metadata.file_type();
        if kind.is_fifo() {
            return "a pipe";
        }
        if kind.is_socket() {
            return "a socket";
        }
        if kind.is_char_device() || kind.is_block_device() {
            return "a device";
        }
    }
    if metadata.is_dir() { "a folder" } else { "something else" }
}

/// A complete file under a temporary name beside its target; removed unless it is put in place.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
    target: PathBuf,
}

impl Temporary {
    /// Writes `bytes` to the disk under a name that no file has.
    pub(crate) fn write(target: &Path, bytes: &[u8]) -> io::Result<Self> {
        let (mut file, temporary) = Self::create(target)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        Ok(temporary)
    }

    /// Moves what is at `target` out of the way, to be removed with this value.
    fn set_aside(target: &Path) -> io::Result<Self> {
        let (_empty, temporary) = Self::create(target)?;
        fs::rename(target, &temporary.path)?;
        Ok(temporary)
    }

    fn create(target: &Path) -> io::Result<(File, Self)> {
        const ATTEMPTS: u32 = 1000;
        let mut last = io::Error::new(ErrorKind::AlreadyExists, "too many temporary files");
        for attempt in 0..ATTEMPTS {
            let mut name = OsString::from(".");
            name.push(target.file_name().unwrap_or_default());
            name.push(format!(".{attempt}.tmp"));
            let path = target.with_file_name(name);
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => {
                    let target = target.to_owned();
                    return Ok((file, Self { path, target }));
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => last = error,
                Err(error) => return Err(error),
            }
        }
        Err(last)
    }

    /// Gives the file its target's name, replacing what has it.
    pub(crate) fn put_in_place(&self) -> io::Result<()> {
        fs::rename(&self.path, &self.target)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // Gone already if it was put in place; nobody is left to tell if it cannot be removed.
        let _ = fs::remove_file(&self.path);
    }
}

/// Writes `bytes` as the file `path`, at once or not at all.
///
/// # Errors
/// A file that exists unless `overwrite`; a folder that cannot be written. What was there is then
/// as it was.
pub fn write_file(path: &Path, bytes: &[u8], overwrite: bool) -> Result<(), IoError> {
    let access = |cause| IoError::Access { path: path.to_owned(), action: "write", cause };
    match fs::symlink_metadata(path) {
        Ok(_) if !overwrite => return Err(IoError::Exists { path: path.to_owned() }),
        Ok(metadata) if metadata.is_dir() => return Err(access(ErrorKind::IsADirectory.into())),
        _ => {}
    }
    Temporary::write(path, bytes).and_then(|file| file.put_in_place()).map_err(access)
}

/// Puts an image and the YAML that names it in place: whoever looks sees the old pair, the new
/// pair, or no YAML, never a YAML beside another map's image. An error before the new image is in
/// place leaves the old pair.
pub(crate) fn put_pair_in_place(image: &Temporary, yaml: &Temporary) -> io::Result<()> {
    let old = match fs::symlink_metadata(&yaml.target) {
        Ok(_) => Some(Temporary::set_aside(&yaml.target)?),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if let Err(error) = image.put_in_place() {
        if let Some(old) = old {
            old.put_in_place()?;
        }
        return Err(error);
    }
    yaml.put_in_place()
}

#[cfg(test)]
mod tests {
    use super::{Temporary, put_pair_in_place, write_file};
    use std::fs;

    #[test]
    fn a_file_is_replaced_only_if_asked_and_leaves_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.json");
        write_file(&path, b"old", false).unwrap();
        assert!(write_file(&path, b"new", false).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        write_file(&path, b"new", true).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert!(write_file(folder.path(), b"new", true).is_err(), "a folder is not a file");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_old_yaml_returns_if_the_new_image_cannot_take_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let (image, yaml) = (folder.path().join("a.pgm"), folder.path().join("a.yaml"));
        fs::create_dir(&image).unwrap();
        fs::write(&yaml, "old").unwrap();
        let new_image = Temporary::write(&image, b"pixels").unwrap();
        let new_yaml = Temporary::write(&yaml, b"new").unwrap();
        assert!(put_pair_in_place(&new_image, &new_yaml).is_err());
        drop((new_image, new_yaml));
        assert_eq!(fs::read_to_string(&yaml).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_yaml_that_cannot_take_its_name_leaves_none_beside_the_new_image() {
        let folder = tempfile::tempdir().unwrap();
        let (image, yaml) = (folder.path().join("a.pgm"), folder.path().join("a.yaml"));
        fs::write(&image, "old pixels").unwrap();
        fs::write(&yaml, "old").unwrap();
        let new_image = Temporary::write(&image, b"pixels").unwrap();
        let new_yaml = Temporary { path: folder.path().join("gone"), target: yaml.clone() };
        assert!(put_pair_in_place(&new_image, &new_yaml).is_err());
        assert!(!yaml.exists());
        assert_eq!(fs::read_to_string(&image).unwrap(), "pixels");
    }
}
