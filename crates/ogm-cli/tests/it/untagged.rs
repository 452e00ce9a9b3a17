//! The papers' methods that need no tags.

use nalgebra::Point2;
use ogm_core::{Grid, Occupancy, OccupancyGrid, Se2};
use ogm_io::{WriteOptions, write_map};
use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::align::assert_close;
use crate::{draw, fixtures, json, ogm, pose, read, truth};

/// What a method without probabilities says of maps that match.
#[track_caller]
fn assert_reported(found: &Value, method: &str, seed: u64) {
    assert_eq!(found["verdict"], "merged");
    assert_eq!((found["method"].as_str(), found["seed"].as_u64()), (Some(method), Some(seed)));
    assert!(found["probability"].is_null(), "not calibrated");
    let [best] = &found["hypotheses"].as_array().unwrap()[..] else { panic!("{found}") };
    assert_eq!(pose(best), pose(&found["target_from_source"]));
    assert!(best["score"].as_f64().unwrap() > 0.0 && best["covariance"].is_null());
    for share in ["overlap", "agreement"] {
        assert!(found[share].as_f64().unwrap() > 0.6, "{share}: {found}");
    }
}

/// The example maps as far as 4 m around one place: fewer walls to compare.
fn small_maps() -> TempDir {
    let folder = tempdir().unwrap();
    let source = read(&fixtures().join("source.yaml"));
    let middle = source.frame().point_from_cells(Point2::new(140.0, 140.0));
    for (name, map_from_source) in [("target", truth()), ("source", Se2::identity())] {
        let mut map = read(&fixtures().join(format!("{name}.yaml")));
        let (frame, place) = (*map.frame(), map_from_source * middle);
        let far = |index| (frame.cell_centre(index) - place).norm() > 4.0;
        let cells = map.cells().indexed();
        let cells = cells.map(|(at, &cell)| if far(at) { Occupancy::UNKNOWN } else { cell });
        let cells = Grid::new(map.width(), map.height(), cells.collect()).unwrap();
        map = ogm_view::crop_known(&OccupancyGrid::new(frame, cells)).unwrap();
        let path = folder.path().join(format!("{name}.yaml"));
        write_map(&path, &map, &WriteOptions::default()).unwrap();
    }
    folder
}

#[test]
fn a_walk_aligns_maps_near_a_rough_prior_and_from_their_middles() {
    let folder = tempdir().unwrap();
    let maps = "align {F}/target.yaml {F}/source.yaml --json --method carpin --seed 3";
    let middles = json(0, folder.path(), maps);
    let prior = json(0, folder.path(), &format!("{maps} --prior -6,-5.5,-20 --prior-sigma 0.5,5"));
    for found in [&middles, &prior] {
        assert_close(found);
        assert_reported(found, "carpin", 3);
    }
    assert_ne!(middles["target_from_source"], prior["target_from_source"], "another walk");
}

#[test]
fn the_papers_picture_distance_can_be_asked_for() {
    let folder = tempdir().unwrap();
    let maps = "align {F}/target.yaml {F}/source.yaml --json --method carpin --prior -6,-5.5,-20 \
                --prior-sigma 0.5,5";
    // The overlap is the default and believed; the other may be refused.
    let overlap = json(0, folder.path(), &format!("{maps} --objective overlap"));
    assert_eq!(overlap["target_from_source"], json(0, folder.path(), maps)["target_from_source"]);
    let picture = ogm(folder.path(), &format!("{maps} --objective picture"));
    let picture: Value = serde_json::from_slice(&picture.stdout).unwrap();
    let first = |found: &Value| found["stages"]["walks"][0]["psi"].as_f64().unwrap();
    assert_ne!(first(&picture), first(&overlap));
}

/// A walk always ends somewhere.
#[test]
fn a_walk_that_ends_at_a_wrong_place_is_refused_there_and_within_its_prior() {
    let folder = tempdir().unwrap();
    let maps = "align {F}/target.yaml {F}/source.yaml --json --method carpin";
    let prior = "--prior -6.4,-5.6,60 --prior-sigma 0.3,3";
    let refused = json(3, folder.path(), &format!("{maps} {prior}"));
    assert_eq!(refused["verdict"], "no-match");
    let reason = refused["reason"].as_str().unwrap();
    assert!(!reason.contains("probability"), "a walk has none: {reason}");
    let turn = pose(&refused["target_from_source"]).theta().to_degrees();
    assert!((turn - 60.0).abs() < 3.0 * 3.0 + 2.0, "{turn}");
}

#[test]
fn the_seed_decides_a_walk() {
    let folder = small_maps();
    let run = |seed: u64| {
        let maps = "align {T}/target.yaml {T}/source.yaml --json --method carpin";
        let prior = "--prior -6,-5.5,-20 --prior-sigma 0.5,5";
        let found = json(0, folder.path(), &format!("{maps} {prior} --seed {seed}"));
        assert_close(&found);
        found["target_from_source"].clone()
    };
    let first = run(1);
    assert_eq!(first, run(1));
    assert_ne!(first, run(2));
}

#[test]
fn walls_that_look_alike_align_maps_without_a_start() {
    let folder = small_maps();
    let maps = "{T}/target.yaml {T}/source.yaml --method radon --seed 3";
    let report = json(0, folder.path(), &format!("merge {maps} -o {{T}}/merged.yaml --json"));
    assert_close(&report["pairs"][0]);
    assert_reported(&report["pairs"][0], "radon", 3);
    assert!(report["output"]["compared_cells"].as_u64().unwrap() > 1000);
    read(&folder.path().join("merged.yaml"));
}

#[test]
fn maps_of_different_floors_are_refused() {
    let folder = small_maps();
    let inside = |x, y| (x % 70 > 3 || y % 50 < 15) && (y % 60 > 3 || x % 45 < 15);
    let row = |y| (0..160).map(|x| if inside(x, y) { '.' } else { '#' }).collect::<String>();
    draw(folder.path(), "other", &(0..130).map(row).collect::<Vec<_>>().join("\n"));
    for method in ["carpin", "radon"] {
        let maps = "{T}/target.yaml {T}/other.yaml";
        let refused = json(3, folder.path(), &format!("align {maps} --json --method {method}"));
        assert_eq!(refused["verdict"], "no-match", "{method}");
        assert!(!refused["reason"].as_str().unwrap().is_empty());
    }
}
