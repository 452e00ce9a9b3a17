//! Outputs with odd names, and outputs that are no files.

use std::fs;
use std::process::{Command, Stdio};

use crate::{draw, ends_with, fixtures, ogm};
use tempfile::tempdir;

const MERGE: &str = "merge {F}/target.yaml {F}/source.yaml";

#[test]
fn names_that_are_no_map_s_are_refused_with_one_that_is() {
    let folder = tempdir().unwrap();
    for (name, proper) in [
        ("{T}/m.pgm", "m.yaml"),
        ("{T}/m.PNG", "m.yaml"),
        ("{T}/merged", "merged.yaml"),
        ("{T}/v1.2", "v1.2.yaml"),
        ("{T}/", "map.yaml"),
        ("-", "name its .yaml"),
        ("/dev/stdout", "name its .yaml"),
    ] {
        for command in [MERGE, "apply {F}/target.yaml --transform 1,0,0"] {
            let command = format!("{command} --force -o {name}");
            let (said, complained) = ends_with(2, folder.path(), &command);
            assert!(said.is_empty() && complained.contains(proper), "{name}: {complained}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[cfg(not(feature = "bags"))]
#[test]
fn a_bag_is_refused_by_a_build_that_writes_none() {
    let folder = tempdir().unwrap();
    let (_, complained) = ends_with(2, folder.path(), &format!("{MERGE} -o {{T}}/m.mcap"));
    assert!(complained.contains("--features bags"), "{complained}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[cfg(feature = "bags")]
#[test]
fn a_merged_map_in_a_bag_is_the_one_in_files_and_is_the_same_bytes_again() {
    let folder = tempdir().unwrap();
    for name in ["m.mcap", "again.mcap", "m.yaml"] {
        ends_with(0, folder.path(), &format!("{MERGE} -o {{T}}/{name}"));
    }
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("m.mcap"), read("again.mcap"));
    let (same, _) = ends_with(0, folder.path(), "align {T}/m.yaml {T}/m.mcap:/map");
    assert!(same.contains("(identity)") && same.contains("walls agree: 100 %"), "{same}");
    ends_with(1, folder.path(), &format!("{MERGE} -o {{T}}/m.mcap"));
}

#[test]
fn pictures_are_not_named_as_something_else() {
    let folder = tempdir().unwrap();
    for name in ["x.jpg", "x.pgm", "x.svg", "x.yaml", "x.json"] {
        let view = format!("view {{F}}/target.yaml -o {{T}}/{name}");
        let overlay = format!("{MERGE} -o {{T}}/m.yaml --overlay {{T}}/{name}");
        for command in [view, overlay] {
            let (_, complained) = ends_with(2, folder.path(), &command);
            assert!(complained.contains("x.png"), "{complained}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    ends_with(0, folder.path(), "view {F}/target.yaml -o {T}/picture");
}

#[test]
fn a_picture_goes_to_standard_output_whatever_that_is() {
    let folder = tempdir().unwrap();
    let names = if cfg!(target_os = "linux") { &["-", "/dev/stdout"][..] } else { &["-"] };
    for name in names {
        let piped = ogm(folder.path(), &format!("view {{F}}/target.yaml -o {name}"));
        assert!(piped.status.success() && piped.stdout.starts_with(b"\x89PNG"), "{name}");
        let file = folder.path().join("out");
        let status = Command::new(env!("CARGO_BIN_EXE_ogm"))
            .args(["view", fixtures().join("target.yaml").to_str().unwrap(), "-o", name])
            .stdout(fs::File::create(&file).unwrap())
            .status()
            .unwrap();
        assert!(status.success());
        assert_eq!(fs::read(&file).unwrap(), piped.stdout, "{name} that is a file");
    }
}

#[test]
fn a_report_on_standard_output_is_alone_there() {
    let folder = tempdir().unwrap();
    let (said, told) =
        ends_with(0, folder.path(), &format!("{MERGE} -o {{T}}/m.yaml --report - --quiet"));
    let report: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(report["pairs"][0]["verdict"], "merged");
    assert!(told.contains("merged") && told.contains("wrote"), "{told}");
    for others in ["--json", "--overlay -"] {
        let command = format!("{MERGE} -o {{T}}/n.yaml --report - {others}");
        let output = ogm(folder.path(), &command);
        assert!(matches!(output.status.code(), Some(1 | 2)) && output.stdout.is_empty());
    }
}

#[test]
#[cfg(unix)]
fn pipes_and_devices_are_neither_replaced_nor_waited_for() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempdir().unwrap();
    let pipe = folder.path().join("pipe.yaml");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    draw(folder.path(), "a", "##\n.?");
    for (command, code) in [
        ("info {T}/pipe.yaml", 1),
        ("align {T}/a.yaml {T}/pipe.yaml", 1),
        ("view {T}/a.yaml --force -o {T}/pipe.yaml", 2),
        ("apply {T}/a.yaml --transform 1,0,0 --force -o {T}/pipe.yaml", 1),
        ("merge {F}/target.yaml {F}/source.yaml -o {T}/m.yaml --report {T}/pipe.yaml --force", 1),
    ] {
        let (_, complained) = ends_with(code, folder.path(), command);
        assert!(code == 2 || complained.contains("a pipe"), "{command}: {complained}");
    }
    assert!(pipe.metadata().unwrap().file_type().is_fifo());
    assert!(!folder.path().join("m.yaml").exists());
    ends_with(0, folder.path(), &format!("{MERGE} -o {{T}}/m.yaml --report /dev/null"));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_for_the_report_leaves_no_map() {
    let folder = tempdir().unwrap();
    let command = format!("{MERGE} -o {{T}}/m.yaml --report /dev/full");
    let (_, complained) = ends_with(1, folder.path(), &command);
    assert!(complained.contains("/dev/full"), "{complained}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
#[cfg(target_os = "linux")]
fn a_result_that_cannot_be_printed_is_an_error_that_says_what_was_written() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "##\n.?");
    let child = Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(["apply", "--transform", "1,0,0", "-o"])
        .args([folder.path().join("m.yaml"), folder.path().join("a.yaml")])
        .stdout(fs::OpenOptions::new().write(true).open("/dev/full").unwrap())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    let complained = String::from_utf8_lossy(&ended.stderr);
    assert!(complained.contains("m.yaml was written"), "{complained}");
}

#[test]
#[cfg(unix)]
fn a_name_that_is_too_long_is_refused_before_the_work() {
    let folder = tempdir().unwrap();
    let name = "m".repeat(251) + ".yaml";
    let (said, complained) = ends_with(1, folder.path(), &format!("{MERGE} -o {{T}}/{name}"));
    assert!(said.is_empty() && complained.contains("too long"), "{complained}");
}
