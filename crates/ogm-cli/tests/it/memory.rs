//! The memory that is told before the work, held against what the work takes.

use std::path::Path;
use std::process::{Command, Stdio};

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_io::{WriteOptions, write_map};
use tempfile::tempdir;

use crate::ends_with;

/// Rooms on `side` × `side` cells, all known.
fn rooms(side: usize, name: &Path) {
    let is_wall = |at: usize| {
        let (column, row) = (at % side, at / side);
        (column % (80 + row / 110 % 7) == 0 && row % 110 > 18)
            || (row % (90 + column / 130 % 5) == 0 && column % 130 > 18)
    };
    let cell = |at| if is_wall(at) { Occupancy::OCCUPIED } else { Occupancy::FREE };
    let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
    let grid = Grid::new(side, side, (0..side * side).map(cell).collect()).unwrap();
    write_map(name, &OccupancyGrid::new(frame, grid), &WriteOptions::default()).unwrap();
}

#[test]
fn what_is_too_large_is_refused_before_the_work_with_both_numbers() {
    let folder = tempdir().unwrap();
    // The head of a large file, and nothing behind it.
    std::fs::write(folder.path().join("a.pgm"), "P5 20000 20000 255\n").unwrap();
    let file = std::fs::OpenOptions::new().append(true).open(folder.path().join("a.pgm")).unwrap();
    file.set_len(19 + 400_000_000).unwrap();
    crate::header(folder.path(), "a", "resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.196");
    for command in ["align {T}/a.yaml {T}/a.yaml", "merge {T}/a.yaml {T}/a.yaml -o {T}/m.yaml"] {
        let command = format!("{command} --max-memory 1G");
        let (_, complained) = ends_with(1, folder.path(), &command);
        for part in ["20000 x 20000", "1.00 GiB", "need about 1."] {
            assert!(complained.contains(part), "{complained}");
        }
    }
    ends_with(2, folder.path(), "info {T}/a.yaml --max-memory plenty");
}

/// Peak resident memory, kibibytes, while `ogm` runs with these words, and what it tells before.
#[cfg(target_os = "linux")]
fn taken_and_told(words: &[&str]) -> (f64, f64) {
    let run = |most: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ogm"));
        command.args(words).args(["--quiet", "--max-memory", most]);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let refused = run("1").wait_with_output().unwrap();
    let complaint = String::from_utf8(refused.stderr).unwrap();
    let behind = complaint.split("need about ").nth(1).unwrap();
    let mut words = behind.split_whitespace();
    let number: f64 = words.next().unwrap().parse().unwrap();
    let told = number * if words.next() == Some("GiB") { 1024.0 * 1024.0 } else { 1024.0 };
    let mut child = run("100G");
    let mut taken = 0;
    let status = loop {
        taken = taken.max(crate::peak_memory(child.id()).unwrap_or(0));
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    };
    assert!(status.success(), "{words:?}");
    (taken as f64, told)
}

/// Holds what is told of aligning a map of `side` cells a side, of merging it, and of merging it
/// with one that is made straight.
#[cfg(target_os = "linux")]
#[track_caller]
fn is_told(side: usize) {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).into_os_string().into_string().unwrap();
    let [map, bent, output] = ["a.yaml", "bent.yaml", "out.yaml"].map(at);
    rooms(side, Path::new(&map));
    // The patches that follow a bend are limited in number, so that of a larger map they are larger.
    let wave_m = (0.2 * 0.05 * side as f64).max(16.0);
    crate::bent::write_waved(Path::new(&map), Path::new(&bent), wave_m);
    let report = at("report.json");
    let straightens = ["merge", &map, &bent, "--bend", "auto", "--report", &report, "-o", &output];
    let commands: [&[&str]; 3] = [
        &["align", &map, &map],
        &["merge", &map, &map, "--bend", "off", "--force", "-o", &output],
        &[&straightens[..], &["--force"]].concat(),
    ];
    for command in commands {
        let (taken, told) = taken_and_told(command);
        let ratio = told / taken;
        assert!((0.95..2.0).contains(&ratio), "{command:?}: told {told} KiB, taken {taken} KiB");
    }
    let report = std::fs::read_to_string(report).unwrap();
    assert!(report.contains("\"applied\": true"), "{report}");
}

#[test]
#[cfg(target_os = "linux")]
fn what_is_told_is_what_is_taken() {
    is_told(700);
}

#[test]
#[cfg(target_os = "linux")]
#[ignore = "minutes and two gigabytes"]
fn what_is_told_is_what_is_taken_by_large_maps() {
    [1500, 3000, 4000, 6000].into_iter().for_each(is_told);
}

/// Maps as large as any: their fused map lies beside them, and nothing is straightened unasked.
#[test]
#[cfg(target_os = "linux")]
#[ignore = "minutes and two gigabytes"]
fn two_maps_of_20_000_cells_a_side_are_merged_in_1600_megabytes() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).into_os_string().into_string().unwrap();
    let [map, output] = ["a.yaml", "out.yaml"].map(at);
    rooms(20_000, Path::new(&map));
    let (taken, told) = taken_and_told(&["merge", &map, &map, "-o", &output]);
    assert!(taken * 1024.0 < 1.6e9, "{taken} KiB");
    assert!(told >= 0.95 * taken, "told {told} KiB, taken {taken} KiB");
}
