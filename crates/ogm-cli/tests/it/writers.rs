//! Two commands that write one map, and commands that are killed while they write.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_io::{WriteOptions, read_map, write_map};
use tempfile::{TempDir, tempdir};

/// Two maps of different sizes and origins, so that a pair of one's YAML and the other's image
/// shows.
fn sources(side: usize) -> TempDir {
    let folder = tempdir().unwrap();
    for number in 0..2 {
        let frame = GridFrame::new(0.05, Se2::new(number as f64, 0.0, 0.0)).unwrap();
        let width = side + number;
        let cells = (0..width * side)
            .map(|at| if at % 7 == 0 { Occupancy::OCCUPIED } else { Occupancy::FREE });
        let map = OccupancyGrid::new(frame, Grid::new(width, side, cells.collect()).unwrap());
        let path = folder.path().join(format!("{number}.yaml"));
        write_map(&path, &map, &WriteOptions::default()).unwrap();
    }
    folder
}

/// Starts to copy source `number` to `output`.
fn writer(sources: &Path, number: usize, output: &Path, force: bool) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ogm"));
    command.args(["apply", "--quiet", "--transform", "0,0,0", "-o"]).arg(output);
    command.arg(sources.join(format!("{number}.yaml")));
    if force {
        command.arg("--force");
    }
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Which of the sources the map at `output` is; it must be one of them as a whole.
#[track_caller]
fn whole(sources: &Path, output: &Path) -> usize {
    let found = read_map(output).unwrap().map;
    let is =
        |number: &usize| found == read_map(&sources.join(format!("{number}.yaml"))).unwrap().map;
    (0..2).find(is).expect("a YAML lies beside another map's image")
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn race(races: usize, force: bool) {
    let sources = sources(40);
    for _ in 0..races {
        let folder = tempdir().unwrap();
        let output = folder.path().join("out.yaml");
        let writers = [0, 1].map(|number| writer(sources.path(), number, &output, force));
        let ended = writers.map(|writer| writer.wait_with_output().unwrap());
        let codes = ended.each_ref().map(|output| output.status.code().unwrap());
        let found = whole(sources.path(), &output);
        if force {
            assert_eq!(codes, [0, 0]);
        } else {
            let loser = 1 - found;
            assert_eq!((codes[found], codes[loser]), (0, 1), "who wrote last is who says so");
            let complaint = String::from_utf8_lossy(&ended[loser].stderr);
            assert!(complaint.contains("exists; name another output"), "{complaint}");
        }
        assert_eq!(names(folder.path()), ["out.pgm", "out.yaml"]);
    }
}

fn kill(kills: u32) {
    let sources = sources(1200);
    let folder = tempdir().unwrap();
    let output = folder.path().join("out.yaml");
    let start = std::time::Instant::now();
    assert!(writer(sources.path(), 0, &output, true).wait().unwrap().success());
    let whole_run = start.elapsed() + Duration::from_millis(2);
    for step in 0..kills {
        let mut child = writer(sources.path(), step as usize % 2, &output, true);
        sleep(whole_run * step / kills);
        child.kill().unwrap();
        child.wait().unwrap();
        if output.exists() {
            whole(sources.path(), &output);
        }
    }
    assert!(writer(sources.path(), 1, &output, true).wait().unwrap().success());
    assert_eq!(whole(sources.path(), &output), 1);
    assert_eq!(names(folder.path()), ["out.pgm", "out.yaml"]);
}

#[test]
fn of_two_commands_that_write_one_map_one_wins_as_a_whole() {
    race(10, true);
    race(10, false);
}

#[test]
fn a_killed_command_leaves_a_whole_pair_or_none_and_the_next_one_clears_up() {
    kill(20);
}

#[test]
#[ignore = "minutes"]
fn two_hundred_races_each_way_tear_and_lose_nothing() {
    race(200, true);
    race(200, false);
}

#[test]
#[ignore = "minutes"]
fn three_hundred_kills_tear_nothing() {
    kill(300);
}

#[test]
#[cfg(unix)]
fn ctrl_c_while_writing_leaves_nothing() {
    let sources = sources(1200);
    let folder = tempdir().unwrap();
    let output = folder.path().join("out.yaml");
    for step in 0..30 {
        let mut child = writer(sources.path(), 0, &output, true);
        sleep(Duration::from_millis(5 * step));
        let id = child.id().to_string();
        Command::new("kill").args(["-INT", &id]).stderr(Stdio::null()).status().unwrap();
        child.wait().unwrap();
        let left = names(folder.path());
        assert!(left.is_empty() || left == ["out.pgm", "out.yaml"], "{left:?}");
    }
}
