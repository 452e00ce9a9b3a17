//! A map on disk is whole or not there.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use ogm_io::{CellEncoding, IoError, WriteOptions, read_map, write_map};

use crate::map;

const OVERWRITE: WriteOptions = WriteOptions { overwrite: true, encoding: CellEncoding::Classes };

/// Names and contents of the files of a folder.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read(&path).unwrap())
        })
        .collect()
}

fn saved_pair(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    write_map(&folder.join("map.yaml"), &map("##\n.."), &WriteOptions::default()).unwrap();
    contents(folder)
}

#[test]
fn existing_files_are_kept_unless_overwriting_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    let old = saved_pair(folder.path());
    let new = map("..\n?#");
    let refused = write_map(&yaml, &new, &WriteOptions::default());
    assert!(matches!(refused, Err(IoError::Exists { path }) if path == yaml));
    assert_eq!(contents(folder.path()), old);

    fs::remove_file(&yaml).unwrap();
    let refused = write_map(&yaml, &new, &WriteOptions::default());
    assert!(matches!(refused, Err(IoError::Exists { path }) if path.ends_with("map.pgm")));

    write_map(&yaml, &new, &OVERWRITE).unwrap();
    write_map(&yaml, &new, &OVERWRITE).unwrap();
    assert_eq!(read_map(&yaml).unwrap().map.cells(), new.cells());
    let names: Vec<String> = contents(folder.path()).into_keys().collect();
    assert_eq!(names, ["map.pgm", "map.yaml"], "no temporaries stay behind");
}

#[test]
fn an_image_that_cannot_be_put_in_place_leaves_the_old_yaml() {
    let folder = tempfile::tempdir().unwrap();
    let old = saved_pair(folder.path());
    fs::create_dir(folder.path().join("map.png")).unwrap();
    let options = WriteOptions { overwrite: true, encoding: CellEncoding::Probabilities };
    let refused = write_map(&folder.path().join("map.yaml"), &map("..\n.."), &options);
    assert!(matches!(refused, Err(IoError::Access { .. })), "{refused:?}");
    assert_eq!(contents(folder.path()), old);
}

#[test]
fn a_folder_that_is_not_there_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("nowhere").join("map.yaml");
    let error = write_map(&yaml, &map("#"), &WriteOptions::default()).unwrap_err();
    assert!(matches!(error, IoError::Access { action: "write", .. }));
    assert!(error.to_string().contains("nowhere"), "{error}");
}

#[test]
#[cfg(unix)]
fn a_folder_that_cannot_be_written_keeps_its_pair() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let old = saved_pair(folder.path());
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
    // A superuser may write everywhere.
    let superuser = fs::write(folder.path().join("probe"), "").is_ok();
    let written = write_map(&folder.path().join("map.yaml"), &map("..\n.."), &OVERWRITE);
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
    if superuser {
        assert!(written.is_ok());
    } else {
        assert!(matches!(written, Err(IoError::Access { .. })));
        assert_eq!(contents(folder.path()), old);
    }
}

#[test]
fn a_name_that_is_the_image_s_own_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["map.pgm", "map.PNG", "..", "a\nb.yaml"] {
        let error = write_map(&folder.path().join(name), &map("#"), &OVERWRITE).unwrap_err();
        assert!(matches!(error, IoError::Access { .. }), "{name:?}: {error}");
    }
    assert!(contents(folder.path()).is_empty());
}

#[test]
fn leftovers_of_a_killed_run_do_not_block() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(".map.yaml.0.tmp"), "half").unwrap();
    saved_pair(folder.path());
    assert!(read_map(&folder.path().join("map.yaml")).is_ok());
}
