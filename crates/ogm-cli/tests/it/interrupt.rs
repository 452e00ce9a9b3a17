//! Ctrl-C.

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_io::{WriteOptions, write_map};
use tempfile::tempdir;

/// Rooms of 4 m on 75 × 75 m: a walk over so many cells takes many seconds.
fn large_map(offset: usize) -> OccupancyGrid {
    let side = 1500;
    let is_wall = |at: usize| {
        let (column, row) = (at % side + offset, at / side + offset);
        (column % 80 == 0 && row % 110 > 18) || (row % 80 == 0 && column % 130 > 18)
    };
    let cell = |at| if is_wall(at) { Occupancy::OCCUPIED } else { Occupancy::FREE };
    let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
    OccupancyGrid::new(frame, Grid::new(side, side, (0..side * side).map(cell).collect()).unwrap())
}

#[test]
fn a_search_ends_soon_after_ctrl_c_and_leaves_no_file() {
    let [inputs, outputs] = [tempdir().unwrap(), tempdir().unwrap()];
    let output = outputs.path().join("merged.yaml");
    let [target, source] = ["a.yaml", "b.yaml"].map(|name| inputs.path().join(name));
    for (map, offset) in [(&target, 0), (&source, 37)] {
        write_map(map, &large_map(offset), &WriteOptions::default()).unwrap();
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(["merge", "--method", "carpin", "-o"])
        .args([&output, &target, &source])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_secs(1));
    let id = child.id().to_string();
    assert!(child.try_wait().unwrap().is_none(), "too fast to be interrupted");
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130));
    assert_eq!(String::from_utf8_lossy(&ended.stdout), "");
    let complained = String::from_utf8_lossy(&ended.stderr);
    assert!(!complained.contains("panicked"), "{complained}");
    assert_eq!(std::fs::read_dir(outputs.path()).unwrap().count(), 0);
}
