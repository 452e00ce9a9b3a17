//! The command as its users run it.

#![expect(clippy::disallowed_methods, reason = "tests make the files that they hand in")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod align;
mod bent;
mod files;
#[cfg(unix)]
mod interrupt;
mod known;
mod memory;
mod merge;
mod mutants;
mod outputs;
mod page;
mod pictures;
mod team;
mod untagged;
mod writers;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ogm_core::{OccupancyGrid, Se2};
use serde_json::Value;

/// Runs `ogm` with the words of `command`; `{F}` is the folder of the example maps and `{T}` is
/// `folder`.
fn ogm(folder: &Path, command: &str) -> Output {
    let place = |word: &str| {
        word.replace("{F}", fixtures().to_str().unwrap()).replace("{T}", folder.to_str().unwrap())
    };
    Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(command.split_whitespace().map(place))
        .output()
        .unwrap()
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/plan-a")
}

/// Runs `ogm`, which has to end with `code`, and gives back what it wrote on both outputs.
#[track_caller]
fn ends_with(code: i32, folder: &Path, command: &str) -> (String, String) {
    let output = ogm(folder, command);
    let [said, complained] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert_eq!(output.status.code(), Some(code), "ogm {command}\n{said}{complained}");
    assert!(!complained.contains("panicked"), "ogm {command}\n{complained}");
    (said, complained)
}

/// Runs `ogm`, which has to end with `code` and to print JSON alone.
#[track_caller]
fn json(code: i32, folder: &Path, command: &str) -> Value {
    let (said, _) = ends_with(code, folder, command);
    serde_json::from_str(&said).unwrap()
}

/// The most memory that a process had at a time so far, kibibytes, where the system tells.
fn peak_memory(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    peak.split_whitespace().next()?.parse().ok()
}

fn pose(json: &Value) -> Se2 {
    let number = |key: &str| json[key].as_f64().unwrap();
    Se2::new(number("x_m"), number("y_m"), number("theta_deg").to_radians())
}

fn truth() -> Se2 {
    let text = std::fs::read_to_string(fixtures().join("truth.json")).unwrap();
    let truth: Value = serde_json::from_str(&text).unwrap();
    pose(&truth["target_from_source"])
}

/// How far `a` and `b` put a point in the middle of the source map apart, metres, and how they
/// differ in rotation, degrees.
fn apart(a: Se2, b: Se2) -> (f64, f64) {
    let source = read(&fixtures().join("source.yaml"));
    let middle = source.frame().point_from_cells(nalgebra::Point2::new(
        source.width() as f64 / 2.0,
        source.height() as f64 / 2.0,
    ));
    ((a * middle - b * middle).norm(), a.between(&b).theta().to_degrees().abs())
}

fn read(yaml: &Path) -> OccupancyGrid {
    ogm_io::read_map(yaml).unwrap().map
}

/// Writes the map `name`.yaml of 0.05 m cells with `picture`: `#` occupied, `.` free, `?` unknown.
fn draw(folder: &Path, name: &str, picture: &str) {
    let rows: Vec<&str> = picture.lines().collect();
    let mut image = format!("P2 {} {} 255\n", rows[0].len(), rows.len());
    for cell in rows.concat().chars() {
        image.push_str(match cell {
            '#' => "0 ",
            '.' => "254 ",
            _ => "205 ",
        });
    }
    std::fs::write(folder.join(format!("{name}.pgm")), image).unwrap();
    header(folder, name, "resolution: 0.05\norigin: [0.0, 0.0, 0.0]\nfree_thresh: 0.196");
}

/// Writes `name`.yaml for the image `name`.pgm with the given lines.
fn header(folder: &Path, name: &str, lines: &str) {
    let yaml = format!("image: {name}.pgm\nnegate: 0\noccupied_thresh: 0.65\n{lines}\n");
    std::fs::write(folder.join(format!("{name}.yaml")), yaml).unwrap();
}
