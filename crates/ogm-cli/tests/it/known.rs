//! Maps in poses that are known, and maps turned along their walls.

use std::fs;

use ogm_core::{ClassThresholds, Se2};
use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::{draw, ends_with, json, pose, read};

/// A room of 2 by 1 m, its door at the right.
const ROOM: &str = "????????????????????????????????????????
????????????????????????????????????????
???##################################???
???#................................#???
???#................................#???
???#................................#???
???#................................#???
???#.........................................
???#.........................................
???#.........................................
???#................................#???
???#................................#???
???#................................#???
???#................................#???
???##################################???
????????????????????????????????????????";

fn rooms() -> TempDir {
    let folder = tempdir().unwrap();
    let room: String = ROOM.lines().map(|row| format!("{row:?<45}\n")).collect();
    for name in ["a", "b", "c"] {
        draw(folder.path(), name, &room);
    }
    folder
}

fn walls(folder: &TempDir, name: &str) -> usize {
    let map = read(&folder.path().join(name));
    map.occupied_points(&ClassThresholds::default()).len()
}

#[test]
fn maps_that_do_not_overlap_are_merged_where_the_user_says() {
    let folder = rooms();
    for given in ["--transform {T}/b.yaml=8,0.5,0", "--prior 8,0.5,0 --prior-sigma 0,0"] {
        let command = "merge {T}/a.yaml {T}/b.yaml -o {T}/m.yaml --force --json";
        let found = json(0, folder.path(), &format!("{command} {given}"));
        let pair = &found["pairs"][0];
        assert_eq!((&pair["verdict"], &pair["method"]), (&"merged".into(), &"known".into()));
        assert_eq!(pose(&pair["target_from_source"]), Se2::new(8.0, 0.5, 0.0));
        assert_eq!((&pair["overlap"], &pair["probability"]), (&0.0.into(), &Value::Null));
        let warning = pair["warnings"][0].as_str().unwrap();
        assert!(warning.contains("too little in common"), "{warning}");
        assert_eq!(walls(&folder, "m.yaml"), 2 * walls(&folder, "a.yaml"));
    }
}

#[test]
fn three_maps_lie_where_they_are_said_to_and_each_is_checked_where_it_overlaps() {
    let folder = rooms();
    let command = "merge {T}/a.yaml {T}/b.yaml {T}/c.yaml -o {T}/m.yaml --report {T}/r.json \
                   --conflicts {T}/c.png --provenance {T}/p.png --frames map,odom \
                   --transform {T}/c.yaml=4.1,0,0 --transform {T}/b.yaml=4,0,0";
    let (said, complained) = ends_with(0, folder.path(), command);
    assert!(complained.is_empty(), "{complained}");
    assert!(said.contains("--frame-id map --child-frame-id odom"), "{said}");
    assert!(said.contains("--frame-id map --child-frame-id robot3/map"), "{said}");
    let report = fs::read(folder.path().join("r.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    assert_eq!(pose(&report["components"][0]["poses"][2]), Se2::new(4.1, 0.0, 0.0));
    let [to_first, to_second] = report["pairs"].as_array().unwrap().as_slice() else {
        panic!("{report}")
    };
    assert_eq!(to_first["overlap"], 0.0);
    assert!(to_second["target"]["file"].as_str().unwrap().ends_with("b.yaml"));
    assert!(to_second["overlap"].as_f64().unwrap() > 0.9, "the third lies on the second");
    for picture in ["c.png", "p.png"] {
        assert!(fs::read(folder.path().join(picture)).unwrap().starts_with(b"\x89PNG"));
    }
}

#[test]
fn a_thing_that_was_moved_is_reported_with_its_place_and_who_says_so() {
    let folder = rooms();
    let with_box: String = ROOM
        .lines()
        .enumerate()
        .map(|(row, cells)| {
            let mut cells = format!("{cells:?<45}");
            if (5..9).contains(&row) {
                cells.replace_range(15..19, "####");
            }
            cells + "\n"
        })
        .collect();
    draw(folder.path(), "b", &with_box);
    let command = "merge {T}/a.yaml {T}/b.yaml -o {T}/m.yaml --transform {T}/b.yaml=0,0,0";
    let found = json(0, folder.path(), &format!("{command} --json"));
    let output = &found["output"];
    assert_eq!(output["fusion"], "keep-walls");
    assert_eq!((&output["conflict_places"], &output["conflict_cells"]), (&1.into(), &16.into()));
    let place = &output["conflicts"][0];
    assert_eq!((&place["occupied"][0], &place["free"][0]), (&1.into(), &0.into()));
    let near = |key: &str, expected: f64| {
        assert!((place[key].as_f64().unwrap() - expected).abs() < 1e-6, "{place}");
    };
    // Rows 5 to 8 from the top of sixteen, columns 15 to 18, of 5 cm.
    near("x_m", 0.85);
    near("y_m", 0.45);
    let (said, _) = ends_with(0, folder.path(), &format!("{command} --force"));
    assert!(said.contains("conflicts: 16 of") && said.contains("0.20 x 0.20 m"), "{said}");
    assert_eq!(walls(&folder, "m.yaml"), walls(&folder, "b.yaml"), "it stays an obstacle");
}

#[test]
fn poses_that_cannot_be_meant_are_usage_errors() {
    let folder = rooms();
    let merge = "merge {T}/a.yaml {T}/b.yaml {T}/c.yaml -o {T}/m.yaml";
    for (given, complaint) in [
        ("--transform {T}/d.yaml=1,0,0", "names none of the maps"),
        ("--transform {T}/b.yaml=1,0", "X,Y,DEG"),
        ("--transform 1,0,0", "MAP.yaml=X,Y,DEG"),
        ("--transform {T}/b.yaml=1,0,0 --transform {T}/b.yaml=2,0,0", "already"),
        ("--transform {T}/b.yaml=1,0,0 --prior 1,0,0 --prior-sigma 1,1", "more than two maps"),
        ("--transform {T}/b.yaml=1,0,0 --prior {T}/b.yaml=1,0,0 --prior-sigma 1,1", "one of them"),
        ("--transform {T}/b.yaml=1,0,0 --transform {T}/c.yaml=1,0,0 --repeats", "no use"),
    ] {
        let (_, complained) = ends_with(2, folder.path(), &format!("{merge} {given}"));
        assert!(complained.contains(complaint), "{given}: {complained}");
    }
    assert!(!folder.path().join("m.yaml").exists());
}

#[test]
fn a_turned_map_is_turned_back_along_its_walls() {
    let folder = tempdir().unwrap();
    let turn_of = |map: &str, output: &str| {
        let command = format!("straighten {map} -o {{T}}/{output}.yaml");
        let (said, _) = ends_with(0, folder.path(), &command);
        let turned = said.split("turned by ").nth(1).unwrap().split(' ').next().unwrap();
        turned.parse::<f64>().unwrap()
    };
    let before = turn_of("{F}/target.yaml", "straight");
    ends_with(0, folder.path(), "apply {F}/target.yaml --transform 1,2,20 -o {T}/turned.yaml");
    let turn = turn_of("{T}/turned.yaml", "back");
    let quarter = (turn - before + 20.0).rem_euclid(90.0);
    assert!(quarter.min(90.0 - quarter) < 0.5, "{before} and {turn}");
    assert!(turn.abs() <= 45.0 && before.abs() > 1.0, "{before} and {turn}");
    assert!(turn_of("{T}/back.yaml", "again").abs() < 0.5);

    draw(folder.path(), "free", &"..........\n".repeat(10));
    ends_with(3, folder.path(), "straighten {T}/free.yaml -o {T}/none.yaml");
    assert!(!folder.path().join("none.yaml").exists());
}
