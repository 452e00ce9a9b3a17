//! The transform between two maps.

use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};

use ogm_core::Se2;
use tempfile::tempdir;

use crate::{apart, draw, ends_with, fixtures, header, json, pose, truth};

/// A cell of the example maps, and a fiftieth of the turn between them.
const CLOSE: (f64, f64) = (0.05, 0.5);

#[track_caller]
pub(crate) fn assert_close(found: &serde_json::Value) {
    let error = apart(pose(&found["target_from_source"]), truth());
    assert!(error.0 < CLOSE.0 && error.1 < CLOSE.1, "{error:?}");
}

#[test]
fn maps_that_match_are_aligned_and_every_field_is_there() {
    let folder = tempdir().unwrap();
    let found = json(0, folder.path(), "align {F}/target.yaml {F}/source.yaml --json --seed 7");
    assert_close(&found);
    assert_eq!(found["schema"], 1);
    assert_eq!(found["verdict"], "merged");
    assert!(found["reason"].is_null());
    assert_eq!(found["method"], "match");
    assert_eq!(found["seed"], 7);
    assert!(found["elapsed_ms"].is_u64());
    for (map, file) in [("target", "target.yaml"), ("source", "source.yaml")] {
        assert!(found[map]["file"].as_str().unwrap().ends_with(file));
        assert_eq!(found[map]["sha256"].as_str().unwrap().len(), 64);
    }
    for share in ["probability", "overlap", "agreement"] {
        let share = found[share].as_f64().unwrap();
        assert!((0.5..=1.0).contains(&share), "{share}");
    }
    let hypotheses = found["hypotheses"].as_array().unwrap();
    assert!((1..=5).contains(&hypotheses.len()));
    assert_eq!(hypotheses[0]["x_m"], found["target_from_source"]["x_m"]);
    let scores: Vec<f64> = hypotheses.iter().map(|h| h["score"].as_f64().unwrap()).collect();
    assert!(scores.is_sorted_by(|a, b| a >= b), "{scores:?}");
    let variances = (0..3).map(|axis| hypotheses[0]["covariance"][axis][axis].as_f64().unwrap());
    assert!(variances.into_iter().all(|variance| variance > 0.0 && variance < 0.01));
    assert_eq!(found["warnings"], serde_json::json!([]));
    assert!(found["stages"]["match"].is_object());
    assert_eq!(found.as_object().unwrap().len(), 15, "fields of schema 1, and two added");
}

#[test]
fn the_image_is_what_is_hashed() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "#");
    // printf 'P2 1 1 255\n0 ' | sha256sum
    let info = json(0, folder.path(), "info {T}/a.yaml --json");
    let digest = "2e500dea18787069a6dcb59282038f14e029fd1bc02401b1e7e4da1588119e5c";
    assert_eq!(info["sha256"], digest);
}

#[test]
fn the_same_command_gives_the_same_bytes_but_for_the_time() {
    let folder = tempdir().unwrap();
    let run = || {
        let mut found = json(0, folder.path(), "align {F}/target.yaml {F}/source.yaml --json");
        found["elapsed_ms"] = 0.into();
        found.to_string()
    };
    assert_eq!(run(), run());
}

#[test]
fn swapped_maps_give_the_inverse() {
    let folder = tempdir().unwrap();
    let there = json(0, folder.path(), "align {F}/target.yaml {F}/source.yaml --json");
    let back = json(0, folder.path(), "align {F}/source.yaml {F}/target.yaml --json");
    let [there, back] = [there, back].map(|found| pose(&found["target_from_source"]));
    let error = apart(there, back.inverse());
    assert!(error.0 < 0.005 && error.1 < 0.05, "{error:?}");
}

#[test]
fn three_good_tags_make_auto_the_third_method() {
    let folder = tempdir().unwrap();
    let tags =
        "--tags {F}/target.yaml={F}/target.tags.csv --tags {F}/source.yaml={F}/source.tags.csv";
    let command = format!("align {{F}}/target.yaml {{F}}/source.yaml --json {tags}");
    let found = json(0, folder.path(), &command);
    assert_eq!(found["method"], "rfid3");
    assert!(found["probability"].is_null(), "not calibrated");
    assert_close(&found);
}

#[test]
fn a_reading_beyond_the_readers_range_is_counted_and_a_longer_range_takes_it() {
    let folder = tempdir().unwrap();
    let log = fs::read_to_string(fixtures().join("source.tags.csv")).unwrap();
    let last = log.lines().last().unwrap();
    let far = format!("{},3.9\n", last.rsplit_once(',').unwrap().0);
    fs::write(folder.path().join("s.csv"), log + &far).unwrap();
    let tags = "--tags {F}/target.yaml={F}/target.tags.csv --tags {F}/source.yaml={T}/s.csv";
    let command = format!("align {{F}}/target.yaml {{F}}/source.yaml --json {tags}");
    let warnings = |options: &str| {
        let found = json(0, folder.path(), &format!("{command} {options}"));
        assert_eq!(found["method"], "rfid3");
        assert_close(&found);
        found["warnings"].to_string()
    };
    assert!(warnings("").contains("1 of "), "{}", warnings(""));
    assert_eq!(warnings("--tag-range 4"), "[]");
}

#[test]
fn too_few_tags_leave_auto_with_the_maps_and_refuse_the_method_by_tags() {
    let folder = tempdir().unwrap();
    let log = "tag_id,robot_x_m,robot_y_m,range_m\n1,0.0,0.0,1.0\n";
    fs::write(folder.path().join("few.csv"), log).unwrap();
    let tags = "--tags {F}/target.yaml={T}/few.csv --tags {F}/source.yaml={T}/few.csv";
    let maps = "align {F}/target.yaml {F}/source.yaml --json";
    let found = json(0, folder.path(), &format!("{maps} {tags}"));
    assert_eq!(found["method"], "match");
    let refused = json(3, folder.path(), &format!("{maps} {tags} --method rfid2"));
    assert_eq!((&refused["verdict"], &refused["method"]), (&"no-match".into(), &"rfid2".into()));
    assert!(refused["reason"].as_str().unwrap().contains("too few tags"));
    assert!(refused["target_from_source"].is_null());
    assert_eq!(refused["hypotheses"].as_array().unwrap().len(), 0);
}

#[test]
fn a_good_prior_is_used_and_a_wrong_one_finds_nothing_there() {
    let folder = tempdir().unwrap();
    let maps = "align {F}/target.yaml {F}/source.yaml --json";
    let good = "--prior -6,-5.5,-20 --prior-sigma 0.5,5";
    assert_close(&json(0, folder.path(), &format!("{maps} {good}")));
    let wrong = "--prior 40,40,90 --prior-sigma 0.1,1";
    json(3, folder.path(), &format!("{maps} {wrong}"));
}

#[test]
fn copies_of_one_map_lie_at_identity_and_it_says_so() {
    let folder = tempdir().unwrap();
    for end in ["yaml", "pgm"] {
        let file = format!("target.{end}");
        fs::copy(fixtures().join(&file), folder.path().join(&file)).unwrap();
    }
    let (said, _) = ends_with(0, folder.path(), "align {F}/target.yaml {T}/target.yaml");
    assert!(said.contains("copies of one map"), "{said}");
    assert!(said.contains("x 0.000 m, y 0.000 m, theta 0.00 deg (identity)"), "{said}");
}

#[test]
fn valid_maps_with_too_little_in_them_are_refused() {
    let folder = tempdir().unwrap();
    let rows = |row: &str| [row; 40].join("\n");
    draw(folder.path(), "cell", "#");
    draw(folder.path(), "unknown", &rows(&"?".repeat(40)));
    draw(folder.path(), "free", &rows(&".".repeat(40)));
    draw(folder.path(), "full", &rows(&"#".repeat(40)));
    for name in ["cell", "unknown", "free", "full"] {
        let command = format!("align {{F}}/target.yaml {{T}}/{name}.yaml");
        let refused = json(3, folder.path(), &format!("{command} --json"));
        assert_eq!(refused["verdict"], "no-match", "{name}");
        assert!(!refused["reason"].as_str().unwrap().is_empty());
        let (said, _) = ends_with(3, folder.path(), &command);
        assert!(said.starts_with("no-match: "), "{said}");
        assert!(!said.contains('\u{1b}'), "no colours in a pipe");
    }
}

/// A square room looks the same from all four sides.
#[test]
fn a_room_with_four_equal_sides_is_ambiguous() {
    let folder = tempdir().unwrap();
    let side = 100;
    let wall = "#".repeat(side);
    let between = format!("#{}#", ".".repeat(side - 2));
    let mut rows = vec![between.as_str(); side];
    (rows[0], rows[side - 1]) = (&wall, &wall);
    draw(folder.path(), "room", &rows.join("\n"));
    fs::copy(folder.path().join("room.pgm"), folder.path().join("moved.pgm")).unwrap();
    header(folder.path(), "moved", "resolution: 0.05\norigin: [1.0, 0.0, 0.0]\nfree_thresh: 0.196");
    let copies = json(0, folder.path(), "align {T}/room.yaml {T}/room.yaml --json");
    let (shift, turn) = apart(pose(&copies["target_from_source"]), Se2::identity());
    assert!(shift < 0.01 && turn < 0.1, "a copy lies on itself: {shift} m, {turn} deg");
    let refused = json(3, folder.path(), "align {T}/room.yaml {T}/moved.yaml --json");
    assert_eq!(refused["verdict"], "ambiguous");
    assert!(refused["target_from_source"].is_object(), "the best one, although refused");
    assert!(refused["hypotheses"].as_array().unwrap().len() >= 2);
}

#[test]
fn command_lines_that_cannot_be_meant_end_with_2() {
    let folder = tempdir().unwrap();
    let maps = "{F}/target.yaml {F}/source.yaml";
    for wrong in [
        "".to_owned(),
        "align".to_owned(),
        "align {F}/target.yaml".to_owned(),
        "compare {F}/target.yaml {F}/source.yaml".to_owned(),
        format!("align {maps} {{F}}/target.yaml"),
        format!("align {maps} --method icp"),
        format!("align {maps} --method rfid3"),
        format!("align {maps} --accept 1.5"),
        format!("align {maps} --accept nan"),
        format!("align {maps} --seed -1"),
        format!("align {maps} --prior 1,2,3"),
        format!("align {maps} --prior 1,2 --prior-sigma 1,1"),
        format!("align {maps} --prior 1,2,3 --prior-sigma 1,1 --method radon"),
        format!("align {maps} --prior nan,2,3 --prior-sigma 1,1"),
        format!("align {maps} --prior 1,2,3 --prior-sigma -1,1"),
        format!("align {maps} --tags {{F}}/target.tags.csv"),
        format!("align {maps} --tags other.yaml={{F}}/target.tags.csv"),
        format!("merge {maps}"),
        "merge {F}/target.yaml -o {T}/out.yaml".to_owned(),
        format!("merge {maps} -o {{T}}/out.yaml --reference {{F}}/other.yaml"),
        format!("merge {maps} {{F}}/target.yaml -o {{T}}/out.yaml --method radon"),
        format!("merge {maps} -o {{T}}/out.yaml --resolution 0"),
        format!("merge {maps} -o {{T}}/out.yaml --fusion mean"),
        format!("view {maps} -o {{T}}/out.png"),
        "view {F}/target.yaml --transform 1,2,3 -o {T}/out.png".to_owned(),
        "apply {F}/target.yaml -o {T}/out.yaml".to_owned(),
        "info".to_owned(),
    ] {
        let (said, complained) = ends_with(2, folder.path(), &wrong);
        assert!(said.is_empty(), "{wrong}: {said}");
        assert!(!complained.is_empty(), "{wrong}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_reader_who_leaves_early_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_ogm"))
        .args(["info", fixtures().join("target.yaml").to_str().unwrap()])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut complained = String::new();
    child.stderr.take().unwrap().read_to_string(&mut complained).unwrap();
    assert_eq!((child.wait().unwrap().code(), complained.as_str()), (Some(0), ""));
}
