//! Writing one file: at once or not at all.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use crate::IoError;
use crate::lock::NameLock;
use crate::target::Target;
use crate::temporary::{Temporary, recover_file};

/// Writes `bytes` as the file `path`, at once or not at all, one writer at a time.
///
/// An existing file keeps its permissions, a symbolic link stays one, and a device is written to
/// and never replaced.
///
/// # Errors
/// A file that exists unless `overwrite`; a folder that cannot be written; a pipe or a socket. What
/// was there is then as it was.
pub fn write_file(path: &Path, bytes: &[u8], overwrite: bool) -> Result<(), IoError> {
    let access = |cause| IoError::Access { path: path.to_owned(), action: "write", cause };
    match Target::of(path).map_err(access)? {
        Target::Device => OpenOptions::new()
            .write(true)
            .open(path)
            .and_then(|mut device| device.write_all(bytes))
            .map_err(access),
        Target::File(place) => {
            let _lock = NameLock::wait(&place, &()).map_err(access)?;
            if !overwrite && fs::symlink_metadata(path).is_ok() {
                return Err(IoError::Exists { path: path.to_owned() });
            }
            replace(&place, bytes).map_err(access)
        }
    }
}

fn replace(place: &Path, bytes: &[u8]) -> io::Result<()> {
    recover_file(place)?;
    Temporary::write(place, |file| file.write_all(bytes))?.put_in_place()
}

#[cfg(test)]
mod tests {
    use super::write_file;
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
}
