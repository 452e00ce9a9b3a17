//! One writer at a time for a name in a folder.
//!
//! The lock is advisory and on a file of its own, which its holder removes. A process that dies lets
//! go of it. On a file system that knows no locks nobody waits.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::Duration;

use ogm_core::Progress;

use crate::hidden::beside;

/// How often, and how long apart, a lock is asked for: a minute, more than any map takes.
const ATTEMPTS: usize = 3000;
const PAUSE: Duration = Duration::from_millis(20);

/// The right to write the file of one name in one folder.
#[derive(Debug)]
pub(crate) struct NameLock {
    path: PathBuf,
    _file: File,
}

impl NameLock {
    /// Waits for the name of `target`; `None` if cancelled.
    pub(crate) fn wait(target: &Path, progress: &dyn Progress) -> io::Result<Option<Self>> {
        for _ in 0..ATTEMPTS {
            if let Some(lock) = Self::attempt(target)? {
                return Ok(Some(lock));
            }
            if progress.is_cancelled() {
                return Ok(None);
            }
            std::thread::sleep(PAUSE);
        }
        let message = "another program has been writing this map for a minute; wait for its end";
        Err(io::Error::new(ErrorKind::ResourceBusy, message))
    }

    /// The lock on the name of `target`, unless another writer has it.
    pub(crate) fn attempt(target: &Path) -> io::Result<Option<Self>> {
        let path = path(target);
        let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Ok(None),
            // A file system without locks: there is nothing to wait for.
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        // Its last holder may have removed it in between.
        Ok(is_still(&path, &file)?.then_some(Self { path, _file: file }))
    }
}

/// Whether a lock on the name of `target` is held, or left by a process that was killed.
pub(crate) fn is_locked(target: &Path) -> bool {
    fs::symlink_metadata(path(target)).is_ok()
}

fn path(target: &Path) -> PathBuf {
    beside(target, target.file_name().unwrap_or_default(), "lock")
}

impl Drop for NameLock {
    fn drop(&mut self) {
        // Nobody is left to tell if it cannot be removed; the next writer takes it as it is.
        let _ = fs::remove_file(&self.path);
    }
}

/// Whether `path` leads to `file`.
fn is_still(path: &Path, file: &File) -> io::Result<bool> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let of_file = file.metadata()?;
        match fs::metadata(path) {
            Ok(of_path) => Ok((of_path.dev(), of_path.ino()) == (of_file.dev(), of_file.ino())),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }
    #[cfg(not(unix))]
    {
        // An open file keeps its name there.
        let _ = (path, file);
        Ok(true)
    }
}
