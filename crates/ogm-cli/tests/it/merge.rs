//! Two maps made one, and what is written on the way.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use nalgebra::{Point2, Vector2};
use ogm_core::{ClassThresholds, OccupancyGrid, Se2};
use tempfile::tempdir;

use crate::{apart, draw, ends_with, fixtures, json, pose, read, truth};

const MERGE: &str = "merge {F}/target.yaml {F}/source.yaml -o {T}/out.yaml";

/// Known cells of `map` whose place in `other` does not hold the same class, and known cells.
fn strays(map: &OccupancyGrid, other: &OccupancyGrid) -> (usize, usize) {
    let thresholds = ClassThresholds::default();
    let known = map.cells().indexed().filter(|(_, cell)| cell.is_known());
    known.fold((0, 0), |(strays, known), (index, &cell)| {
        let there = other.at(map.frame().cell_centre(index));
        let differs = thresholds.classify(cell) != thresholds.classify(there);
        (strays + usize::from(differs), known + 1)
    })
}

#[test]
fn the_merged_map_keeps_the_first_and_adds_the_second() {
    let folder = tempdir().unwrap();
    let extras = "--fusion first --report {T}/r.json --overlay {T}/o.png";
    let (said, _) = ends_with(0, folder.path(), &format!("{MERGE} {extras}"));
    let merged = read(&folder.path().join("out.yaml"));
    let target = read(&fixtures().join("target.yaml"));
    assert_eq!(merged.frame().map_from_grid().theta(), 0.0);
    assert_eq!(strays(&target, &merged).0, 0, "the first map's cells are copied");
    let known = |map: &OccupancyGrid| map.cells().cells().iter().filter(|c| c.is_known()).count();
    assert!(known(&merged) > known(&target) * 5 / 4);

    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("r.json")).unwrap()).unwrap();
    assert_eq!(report["schema"], 1);
    assert_eq!(report["maps"].as_array().unwrap().len(), 2);
    let pair = &report["pairs"][0];
    assert_eq!(pair["verdict"], "merged");
    let components = report["components"].as_array().unwrap();
    assert_eq!(components.len(), 1);
    assert_eq!(pose(&components[0]["poses"][0]), Se2::identity());
    let error = apart(pose(&components[0]["poses"][1]), truth());
    assert!(error.0 < 0.05 && error.1 < 0.5, "{error:?}");
    assert_eq!(components[0]["covariances"][1], pair["hypotheses"][0]["covariance"]);
    assert_eq!(report["output"]["width"], merged.width());
    assert!(fs::read(folder.path().join("o.png")).unwrap().starts_with(b"\x89PNG"));

    let transform = pose(&pair["target_from_source"]);
    let command = format!(
        "ros2 run tf2_ros static_transform_publisher --x {:.6} --y {:.6} --yaw {:.6} --frame-id",
        transform.x(),
        transform.y(),
        transform.theta()
    );
    assert!(said.contains(&command), "{said}");
    let files = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(files, 4, "map, image, report, overlay and nothing else");
}

/// Planners drive through what is unknown or free. The maps are laid two cells beside the truth, as
/// no pose is exact.
#[test]
fn every_wall_of_both_maps_has_a_wall_beside_it_in_the_merged_one() {
    let folder = tempdir().unwrap();
    let (x, y, theta) = (truth().x() + 0.1, truth().y(), truth().theta().to_degrees());
    let merge = format!("{MERGE} --force --json --transform {{F}}/source.yaml={x},{y},{theta}");
    let lost = |rule: &str| {
        let found = json(0, folder.path(), &format!("{merge} {rule}"));
        let merged = read(&folder.path().join("out.yaml"));
        let poses = &found["components"][0]["poses"];
        let of_maps = ["target", "source"].into_iter().zip(poses.as_array().unwrap());
        let lost = of_maps.map(|(map, reference_from_map)| {
            let map = read(&fixtures().join(format!("{map}.yaml")));
            let walls = map.occupied_points(&ClassThresholds::default());
            let moved = walls.iter().map(|wall| pose(reference_from_map) * *wall);
            moved.filter(|wall| !has_wall_near(&merged, *wall)).count()
        });
        lost.sum::<usize>()
    };
    assert_eq!(lost(""), 0);
    assert!(lost("--fusion log-odds") > 100, "a rule by the cell loses walls");
}

/// Whether a wall cell of `map` is centred within 1.5 cells of `place`.
fn has_wall_near(map: &OccupancyGrid, place: Point2<f64>) -> bool {
    let cell = map.frame().resolution();
    let around = (0..25).map(|at| Vector2::new(f64::from(at % 5) - 2.0, f64::from(at / 5) - 2.0));
    around.filter_map(|offset| map.cell_at(place + offset * cell)).any(|index| {
        let centre = map.frame().cell_centre(index);
        let is_wall = ClassThresholds::default().is_occupied(map.at(centre));
        is_wall && (centre - place).norm() <= 1.5 * cell
    })
}

#[test]
fn another_resolution_and_json_on_standard_output() {
    let folder = tempdir().unwrap();
    let merged = json(0, folder.path(), &format!("{MERGE} --resolution 0.1 --json"));
    assert_eq!(merged["output"]["resolution_m"], 0.1);
    assert_eq!(read(&folder.path().join("out.yaml")).frame().resolution(), 0.1);
}

#[test]
fn a_copy_merges_into_the_same_map() {
    let folder = tempdir().unwrap();
    let (said, _) =
        ends_with(0, folder.path(), "merge {F}/target.yaml {F}/target.yaml -o {T}/out.yaml");
    assert!(said.contains("copies of one map") && said.contains("(identity)"), "{said}");
    let target = read(&fixtures().join("target.yaml"));
    let merged = read(&folder.path().join("out.yaml"));
    let (strays, known) = strays(&target, &merged);
    assert!(strays * 20 < known, "{strays} of {known} cells changed");
}

#[test]
fn a_moved_map_is_found_again() {
    let folder = tempdir().unwrap();
    ends_with(0, folder.path(), "apply {F}/source.yaml --transform -3.5,2.25,-40 -o {T}/b.yaml");
    let found = json(0, folder.path(), "align {F}/target.yaml {T}/b.yaml --json");
    let moved_from_source = Se2::new(-3.5, 2.25, -40_f64.to_radians());
    let target_from_source = pose(&found["target_from_source"]) * moved_from_source;
    let error = apart(target_from_source, truth());
    assert!(error.0 < 0.1 && error.1 < 1.0, "{error:?}");
}

#[test]
fn a_refusal_writes_a_report_and_no_map() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "dot", "#");
    let command = "merge {F}/target.yaml {T}/dot.yaml -o {T}/out.yaml --overlay {T}/o.png";
    let (said, complained) =
        ends_with(3, folder.path(), &format!("{command} --report {{T}}/r.json"));
    assert!(said.starts_with("no-match: too little structure"), "{said}");
    assert!(complained.contains("o.png is not drawn"), "{complained}");
    let report = fs::read_to_string(folder.path().join("r.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["components"].as_array().unwrap().len(), 2, "each map alone");
    assert!(report["output"].is_null());
    for absent in ["out.yaml", "out.pgm", "o.png"] {
        assert!(!folder.path().join(absent).exists(), "{absent}");
    }
    let (said, _) = ends_with(3, folder.path(), &format!("{command} --allow-partial --quiet"));
    assert!(said.contains("target.yaml alone"), "{said}");
    let target = read(&fixtures().join("target.yaml"));
    assert_eq!(read(&folder.path().join("out.yaml")), target);
}

#[test]
fn existing_files_are_kept_unless_forced_and_inputs_always() {
    let folder = tempdir().unwrap();
    for name in ["target", "source"] {
        for end in ["yaml", "pgm"] {
            let file = format!("{name}.{end}");
            fs::copy(fixtures().join(&file), folder.path().join(&file)).unwrap();
        }
    }
    fs::write(folder.path().join("out.pgm"), "precious").unwrap();
    fs::write(folder.path().join("r.json"), "precious").unwrap();
    let maps = "merge {T}/target.yaml {T}/source.yaml";
    for outputs in ["-o {T}/out.yaml", "-o {T}/new.yaml --report {T}/r.json"] {
        let (_, complained) = ends_with(1, folder.path(), &format!("{maps} {outputs}"));
        assert!(complained.contains("exists; name another output or overwrite it with --force"));
    }
    assert!(!folder.path().join("new.yaml").exists());
    let tags = "--tags {T}/target.yaml={F}/target.tags.csv";
    for outputs in [
        "-o {T}/target.yaml",
        "-o {T}/source.yaml",
        "-o {T}/source.pgm",
        "-o {T}/new.yaml --report {T}/target.yaml",
        "-o {T}/new.yaml --overlay {T}/source.pgm",
        "-o {T}/new.yaml --report {F}/target.tags.csv",
        "-o {T}/new.yaml --report {T}/../{T}/target.pgm",
    ] {
        let command = format!("{maps} {tags} {outputs} --force");
        let (_, complained) = ends_with(1, folder.path(), &command);
        let refused =
            complained.contains("never overwritten") || complained.contains("cannot be used");
        assert!(refused, "{outputs}: {complained}");
    }
    for name in ["target", "source"] {
        for end in ["yaml", "pgm"] {
            let file = format!("{name}.{end}");
            let [kept, original] =
                [folder.path(), &fixtures()].map(|f| fs::read(f.join(&file)).unwrap());
            assert!(kept == original, "{file}");
        }
    }
    let (_, complained) =
        ends_with(1, folder.path(), &format!("{maps} -o {{T}}/n.yaml --report {{T}}/n.pgm"));
    assert!(complained.contains("named for two outputs"), "{complained}");
    ends_with(0, folder.path(), &format!("{maps} -o {{T}}/out.yaml --report {{T}}/r.json --force"));
    read(&folder.path().join("out.yaml"));
}

/// Whenever it is killed, a YAML that is there stands beside its own image.
#[test]
fn a_kill_leaves_no_map_beside_another_image() {
    let folder = tempdir().unwrap();
    let yaml = folder.path().join("out.yaml");
    draw(folder.path(), "out", "##\n#.");
    let old = read(&yaml);
    ends_with(0, folder.path(), &MERGE.replace("out.yaml", "new.yaml"));
    let new = read(&folder.path().join("new.yaml"));
    for milliseconds in [0, 20, 60, 100, 140, 180, 220, 260] {
        let arguments = ["merge", "--force", "-o"];
        let mut child = Command::new(env!("CARGO_BIN_EXE_ogm"))
            .args(arguments)
            .args([&yaml, &fixtures().join("target.yaml"), &fixtures().join("source.yaml")])
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        child.kill().unwrap();
        child.wait().unwrap();
        if yaml.exists() {
            let map = read(&yaml);
            assert!(map == old || map == new, "after {milliseconds} ms");
        }
    }
}
