//! Complete files under temporary names, and what a killed writer left of them.
//!
//! Whoever calls these holds the lock on the name, so the temporary names are nobody else's.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::hidden::beside;

/// A complete file under a temporary name beside its target; removed unless it is put in place.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
    target: PathBuf,
}

impl Temporary {
    /// Writes what `fill` writes to the disk, with the permissions of what it is to replace.
    pub(crate) fn write(
        target: &Path,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<Self> {
        let temporary = Self { path: new(target), target: target.to_owned() };
        remove(&temporary.path)?;
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary.path)?;
        if let Ok(replaced) = fs::metadata(target) {
            file.set_permissions(replaced.permissions())?;
        }
        let mut buffered = BufWriter::with_capacity(1 << 16, file);
        fill(&mut buffered)?;
        let file: File = buffered.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.sync_all()?;
        Ok(temporary)
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

/// Puts an image and the YAML that names it in place: whoever looks sees the old pair, the new
/// pair, or no YAML, never a YAML beside another map's image. An error before the new image is in
/// place leaves the old pair.
pub(crate) fn put_pair_in_place(image: &Temporary, yaml: &Temporary) -> io::Result<()> {
    let old = old(&yaml.target);
    remove(&old)?;
    let was_there = match fs::rename(&yaml.target, &old) {
        Ok(()) => true,
        Err(error) if error.kind() == ErrorKind::NotFound => false,
        Err(error) => return Err(error),
    };
    if let Err(error) = image.put_in_place() {
        if was_there {
            fs::rename(&old, &yaml.target)?;
        }
        return Err(error);
    }
    yaml.put_in_place()?;
    remove(&old)
}

/// Ends what a killed writer began: where the new image is in place, so is its YAML afterwards;
/// where it is not, the old YAML returns. Nothing temporary of these names is left.
pub(crate) fn recover_pair(image: &Path, yaml: &Path) -> io::Result<()> {
    let (new_image, new_yaml, old_yaml) = (new(image), new(yaml), old(yaml));
    if !exists(yaml) {
        if exists(&new_image) {
            rename_if_there(&old_yaml, yaml)?;
        } else if exists(&new_yaml) && exists(image) {
            fs::rename(&new_yaml, yaml)?;
        }
    }
    for left in [new_image, new_yaml, old_yaml] {
        remove(&left)?;
    }
    Ok(())
}

/// Removes what a killed writer of the file `target` left.
pub(crate) fn recover_file(target: &Path) -> io::Result<()> {
    remove(&new(target))
}

/// Whether a killed writer left anything of the file `target`.
pub(crate) fn is_left(target: &Path) -> bool {
    exists(&new(target)) || exists(&old(target))
}

fn new(target: &Path) -> PathBuf {
    beside(target, target.file_name().unwrap_or_default(), "new.tmp")
}

fn old(target: &Path) -> PathBuf {
    beside(target, target.file_name().unwrap_or_default(), "old.tmp")
}

fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

fn remove(path: &Path) -> io::Result<()> {
    ignore_absence(fs::remove_file(path))
}

fn rename_if_there(from: &Path, to: &Path) -> io::Result<()> {
    ignore_absence(fs::rename(from, to))
}

fn ignore_absence(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::{Temporary, new, old, put_pair_in_place, recover_pair};
    use std::fs;
    use std::path::{Path, PathBuf};

    fn written(target: &Path, text: &str) -> Temporary {
        Temporary::write(target, |file| file.write_all(text.as_bytes())).unwrap()
    }

    fn pair(folder: &Path) -> (PathBuf, PathBuf) {
        (folder.join("a.pgm"), folder.join("a.yaml"))
    }

    #[test]
    fn the_old_yaml_returns_if_the_new_image_cannot_take_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let (image, yaml) = pair(folder.path());
        fs::create_dir(&image).unwrap();
        fs::write(&yaml, "old").unwrap();
        let (new_image, new_yaml) = (written(&image, "pixels"), written(&yaml, "new"));
        assert!(put_pair_in_place(&new_image, &new_yaml).is_err());
        drop((new_image, new_yaml));
        assert_eq!(fs::read_to_string(&yaml).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_yaml_that_cannot_take_its_name_leaves_none_beside_the_new_image() {
        let folder = tempfile::tempdir().unwrap();
        let (image, yaml) = pair(folder.path());
        fs::write(&image, "old pixels").unwrap();
        fs::write(&yaml, "old").unwrap();
        let new_image = written(&image, "pixels");
        let new_yaml = Temporary { path: folder.path().join("gone"), target: yaml.clone() };
        assert!(put_pair_in_place(&new_image, &new_yaml).is_err());
        assert!(!yaml.exists());
        assert_eq!(fs::read_to_string(&image).unwrap(), "pixels");
    }

    /// A writer that is killed after each of its steps, over an old pair or none.
    #[test]
    fn after_a_kill_at_any_step_there_is_a_whole_pair_and_nothing_beside_it() {
        for had_old in [true, false] {
            for steps in 0..=5 {
                let folder = tempfile::tempdir().unwrap();
                let (image, yaml) = pair(folder.path());
                if had_old {
                    fs::write(&image, "old").unwrap();
                    fs::write(&yaml, "old").unwrap();
                }
                let step: [&dyn Fn(); 5] = [
                    &|| fs::write(new(&image), "new").unwrap(),
                    &|| fs::write(new(&yaml), "new").unwrap(),
                    &|| drop(fs::rename(&yaml, old(&yaml))),
                    &|| fs::rename(new(&image), &image).unwrap(),
                    &|| fs::rename(new(&yaml), &yaml).unwrap(),
                ];
                step.iter().take(steps).for_each(|step| step());
                recover_pair(&image, &yaml).unwrap();
                let [image, yaml] = [image, yaml].map(|path| fs::read_to_string(path).ok());
                assert_eq!(image, yaml, "old {had_old}, {steps} steps");
                let expected = if steps >= 4 { Some("new") } else { had_old.then_some("old") };
                assert_eq!(yaml.as_deref(), expected, "old {had_old}, {steps} steps");
                let left = fs::read_dir(folder.path()).unwrap().count();
                assert_eq!(left, 2 * usize::from(expected.is_some()), "old {had_old}, {steps}");
            }
        }
    }
}
