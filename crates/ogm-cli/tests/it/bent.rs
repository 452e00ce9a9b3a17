//! A map that drift bent is made straight on the way, and nothing else changes by that.

use std::fs;
use std::path::Path;

use nalgebra::Vector2;
use ogm_core::OccupancyGrid;
use serde_json::Value;
use tempfile::tempdir;

use crate::{ends_with, fixtures, json, read};

/// The example's source map, bent.
fn write_bent(folder: &Path) {
    write_waved(&fixtures().join("source.yaml"), &folder.join("bent.yaml"), 16.0);
}

/// The map at `straight`, bent by up to 0.15 m along each axis in waves of so many metres.
pub(crate) fn write_waved(straight: &Path, waved: &Path, wave_m: f64) {
    let map = read(straight);
    let mut bent = map.clone();
    for (at, _) in map.cells().indexed() {
        let place = map.frame().cell_centre(at);
        let wave = |along: f64| 0.15 * (along * std::f64::consts::TAU / wave_m).sin();
        let from = place + Vector2::new(wave(place.y), wave(place.x));
        *bent.cells_mut().get_mut(at).unwrap() = map.at(from);
    }
    ogm_io::write_map(waved, &bent, &ogm_io::WriteOptions::default()).unwrap();
}

/// Less what says when.
fn timeless(mut answer: Value) -> Value {
    answer["pairs"][0]["elapsed_ms"] = Value::Null;
    answer
}

fn walls(map: &OccupancyGrid) -> usize {
    map.occupied_points(&ogm_core::ClassThresholds::default()).len()
}

#[test]
fn a_bent_map_is_made_straight_and_the_poses_stay_what_they_are() {
    let folder = tempdir().unwrap();
    write_bent(folder.path());
    let merge = "merge {F}/target.yaml {T}/bent.yaml --fusion occupied --json";
    let off = timeless(json(0, folder.path(), &format!("{merge} -o {{T}}/off.yaml --bend off")));
    let auto = format!("{merge} -o {{T}}/auto.yaml --bend-picture {{T}}/b.png");
    let auto = timeless(json(0, folder.path(), &auto));
    let report = format!("{merge} -o {{T}}/report.yaml --bend report");
    let report = timeless(json(0, folder.path(), &report));
    for part in ["maps", "pairs", "components"] {
        assert_eq!(off[part].to_string(), auto[part].to_string(), "{part}");
        assert_eq!(off[part].to_string(), report[part].to_string(), "{part}");
    }
    assert!(off.get("bend").is_none());
    assert_eq!(auto["bend"][0]["applied"], true, "{}", auto["bend"]);
    assert_eq!(report["bend"][0]["applied"], false);
    assert_eq!(report["bend"][0]["significant"], true);
    let most = auto["bend"][0]["max_m"].as_f64().unwrap();
    assert!((0.05..0.6).contains(&most), "{most} m");
    assert!(fs::read(folder.path().join("b.png")).unwrap().starts_with(b"\x89PNG"));

    let image = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(image("off.pgm"), image("report.pgm"), "a report changes no map");
    // Walls that lie twice in one map lie once in the other.
    let [off, auto] = ["off.yaml", "auto.yaml"].map(|name| walls(&read(&folder.path().join(name))));
    assert!(auto * 25 < off * 24, "{auto} cells of wall, {off} without");
}

#[test]
fn people_are_told_where_a_map_was_bent() {
    let folder = tempdir().unwrap();
    write_bent(folder.path());
    let merge = "merge {F}/target.yaml {T}/bent.yaml -o {T}/out.yaml";
    let (said, _) = ends_with(0, folder.path(), merge);
    assert!(said.contains("bent.yaml was bent and is made straight: by 0."), "{said}");
    let straight = "merge {F}/target.yaml {F}/source.yaml -o {T}/out2.yaml";
    let (said, _) = ends_with(0, folder.path(), straight);
    assert!(!said.contains("bent"), "{said}");
    let (said, _) = ends_with(0, folder.path(), &format!("{straight} --force --bend report"));
    assert!(said.contains("source.yaml is not bent"), "{said}");
}
