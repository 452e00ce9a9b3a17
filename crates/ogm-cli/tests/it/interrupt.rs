//! Ctrl-C.

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::tempdir;

use crate::fixtures;

/// In a debug build this walk takes many seconds.
#[test]
fn a_search_ends_soon_after_ctrl_c_and_leaves_no_file() {
    let folder = tempdir().unwrap();
    let output = folder.path().join("merged.yaml");
    let [target, source] = ["target.yaml", "source.yaml"].map(|name| fixtures().join(name));
    let mut child = Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(["merge", "--method", "carpin", "-o"])
        .args([&output, &target, &source])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_millis(400));
    let id = child.id().to_string();
    assert!(child.try_wait().unwrap().is_none(), "too fast to be interrupted");
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130));
    assert_eq!(String::from_utf8_lossy(&ended.stdout), "");
    let complained = String::from_utf8_lossy(&ended.stderr);
    assert!(complained.contains("Ctrl-C"), "{complained}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
