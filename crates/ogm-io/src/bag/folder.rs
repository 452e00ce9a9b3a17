//! The files that a bag is made of.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::BagError;
use crate::IoError;

/// `bag` itself if it is a file, else the bag files in the folder, in the order of their numbers.
pub(super) fn files_of(bag: &Path) -> Result<Vec<PathBuf>, IoError> {
    if !bag.is_dir() {
        return Ok(vec![bag.to_owned()]);
    }
    let access = |cause| IoError::Access { path: bag.to_owned(), action: "read", cause };
    let mut files = Vec::new();
    for entry in fs::read_dir(bag).map_err(access)? {
        let path = entry.map_err(access)?.path();
        let is_bag = path.extension().is_some_and(|end| end == "mcap" || end == "db3");
        if is_bag && path.is_file() {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(IoError::Bag { path: bag.to_owned(), cause: BagError::NotABag });
    }
    files.sort_by_cached_key(|file| {
        number_in(file).map_or((0, file.clone()), |n| (n, file.clone()))
    });
    Ok(files)
}

/// The number that `ros2 bag` ends the names of a split bag with.
fn number_in(file: &Path) -> Option<u64> {
    file.file_stem()?.to_str()?.rsplit_once('_')?.1.parse().ok()
}
