//! Several writers and readers of one map at once.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use ogm_core::{Cancelled, GridFrame, OccupancyGrid, Progress, Se2};
use ogm_io::{IoError, StagedMap, WriteOptions, read_map, recover_map, write_file, write_map};

use crate::map;

const OVERWRITE: WriteOptions =
    WriteOptions { overwrite: true, encoding: ogm_io::CellEncoding::Classes };

/// One of two maps of which image and YAML tell which it is.
fn numbered(number: usize) -> OccupancyGrid {
    let frame = GridFrame::new(0.05, Se2::new(number as f64, 0.0, 0.0)).unwrap();
    OccupancyGrid::from_ascii(frame, ["###\n...", "..\n##\n??"][number]).unwrap()
}

#[track_caller]
fn assert_whole(found: &OccupancyGrid) {
    assert!((0..2).any(|number| *found == numbered(number)), "{found:?}");
}

/// Ends the writers, however the reading ends.
struct Ending<'a>(&'a AtomicBool);

impl Drop for Ending<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Reads while two writers take turns, as often as asked for.
fn read_while_writing(reads: usize) {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    write_map(&yaml, &numbered(0), &OVERWRITE).unwrap();
    let ended = AtomicBool::new(false);
    thread::scope(|scope| {
        for number in 0..2 {
            let (yaml, ended) = (&yaml, &ended);
            scope.spawn(move || {
                while !ended.load(Ordering::Relaxed) {
                    write_map(yaml, &numbered(number), &OVERWRITE).unwrap();
                }
            });
        }
        let _ending = Ending(&ended);
        let mut gaps = 0;
        for _ in 0..reads {
            match read_map(&yaml) {
                Ok(loaded) => assert_whole(&loaded.map),
                // The documented gap: for a moment there is no YAML, mostly waited for.
                Err(IoError::Access { cause, .. }) => {
                    assert_eq!(cause.kind(), std::io::ErrorKind::NotFound);
                    gaps += 1;
                }
                Err(error) => panic!("{error}"),
            }
        }
        assert!(gaps <= reads / 100, "{gaps} of {reads} reads found no map");
    });
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn readers_see_whole_pairs_while_two_writers_take_turns() {
    read_while_writing(300);
}

#[test]
#[ignore = "minutes"]
fn of_100_000_reads_none_sees_a_torn_pair() {
    read_while_writing(100_000);
}

/// A writer that replaces pairs far faster than the disk takes them, in the documented order.
#[test]
fn a_pair_that_is_replaced_between_its_two_files_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let pairs = [0, 1].map(|number| {
        let yaml = at(&format!("{number}.yaml"));
        write_map(&yaml, &numbered(number), &OVERWRITE).unwrap();
        let text = fs::read_to_string(&yaml).unwrap().replace(&format!("{number}.pgm"), "map.pgm");
        (text, fs::read(yaml.with_extension("pgm")).unwrap())
    });
    let (image, yaml) = (at("map.pgm"), at("map.yaml"));
    let ended = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| {
            for (text, pixels) in pairs.iter().cycle() {
                if ended.load(Ordering::Relaxed) {
                    break;
                }
                fs::write(at("new.pgm"), pixels).unwrap();
                fs::write(at("new.yaml"), text).unwrap();
                let _ = fs::remove_file(&yaml);
                fs::rename(at("new.pgm"), &image).unwrap();
                fs::rename(at("new.yaml"), &yaml).unwrap();
            }
        });
        let _ending = Ending(&ended);
        for _ in 0..40_000 {
            if let Ok(loaded) = read_map(&yaml) {
                assert_whole(&loaded.map);
            }
        }
    });
}

#[test]
fn of_two_writers_without_force_one_is_refused() {
    for _ in 0..20 {
        let folder = tempfile::tempdir().unwrap();
        let yaml = folder.path().join("map.yaml");
        let yaml = &yaml;
        let ends: Vec<_> = thread::scope(|scope| {
            let write =
                |number| move || write_map(yaml, &numbered(number), &WriteOptions::default());
            let writers = [scope.spawn(write(0)), scope.spawn(write(1))];
            writers.into_iter().map(|writer| writer.join().unwrap()).collect()
        });
        let winner = ends.iter().position(Result::is_ok).unwrap();
        assert!(matches!(ends[1 - winner], Err(IoError::Exists { .. })), "{ends:?}");
        assert_eq!(read_map(yaml).unwrap().map, numbered(winner));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}

#[test]
fn a_map_that_is_not_put_in_place_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    write_map(&yaml, &numbered(0), &OVERWRITE).unwrap();
    let staged = StagedMap::write(&yaml, &numbered(1), &OVERWRITE, &()).unwrap();
    assert_eq!(read_map(&yaml).unwrap().map, numbered(0));
    drop(staged);
    assert_eq!(read_map(&yaml).unwrap().map, numbered(0));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[derive(Debug)]
struct Impatient;

impl Progress for Impatient {
    fn report(&self, _share: f64) {}

    fn is_cancelled(&self) -> bool {
        true
    }
}

#[test]
fn a_cancelled_writing_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    let ended = StagedMap::write(&yaml, &numbered(0), &OVERWRITE, &Impatient);
    assert!(matches!(ended, Err(IoError::Cancelled(Cancelled))));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_name_as_long_as_the_file_system_allows_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("m".repeat(250) + ".yaml");
    write_map(&yaml, &numbered(1), &WriteOptions::default()).unwrap();
    write_map(&yaml, &numbered(0), &OVERWRITE).unwrap();
    assert_eq!(read_map(&yaml).unwrap().map, numbered(0));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_lock_that_a_killed_writer_left_is_taken_away() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    fs::write(folder.path().join(".map.yaml.lock"), "").unwrap();
    recover_map(&yaml).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
#[cfg(unix)]
fn permissions_and_links_of_what_is_replaced_are_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let [here, there] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let (link, yaml) = (here.path().join("map.yaml"), there.path().join("real.yaml"));
    fs::write(&yaml, "old").unwrap();
    fs::set_permissions(&yaml, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&yaml, &link).unwrap();
    write_map(&link, &map("#."), &OVERWRITE).unwrap();
    assert!(link.symlink_metadata().unwrap().is_symlink());
    assert_eq!(yaml.metadata().unwrap().permissions().mode() & 0o777, 0o640);
    assert_eq!(read_map(&link).unwrap().map.to_ascii(), "#.\n");

    let dangling = here.path().join("report.json");
    symlink(there.path().join("report.json"), &dangling).unwrap();
    assert!(write_file(&dangling, b"{}", false).is_err(), "a link is there already");
    write_file(&dangling, b"{}", true).unwrap();
    assert!(dangling.symlink_metadata().unwrap().is_symlink());
    assert_eq!(fs::read(there.path().join("report.json")).unwrap(), b"{}");
}

#[test]
#[cfg(unix)]
fn devices_and_sockets_are_not_replaced() {
    use std::os::unix::net::UnixListener;
    write_file(Path::new("/dev/null"), b"{}", true).unwrap();
    write_file(Path::new("/dev/null"), b"{}", false).unwrap();
    assert!(write_map(Path::new("/dev/null"), &map("#"), &OVERWRITE).is_err());
    if Path::new("/dev/full").exists() {
        assert!(write_file(Path::new("/dev/full"), b"{}", true).is_err());
    }
    let folder = tempfile::tempdir().unwrap();
    let socket = folder.path().join("map.yaml");
    let _listener = UnixListener::bind(&socket).unwrap();
    for error in [
        write_file(&socket, b"{}", true).unwrap_err(),
        write_map(&socket, &map("#"), &OVERWRITE).unwrap_err(),
    ] {
        assert!(error.to_string().contains("a socket"), "{error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
