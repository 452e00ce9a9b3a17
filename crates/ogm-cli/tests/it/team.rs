//! More than two maps made one.

use std::fs;

use ogm_core::Se2;
use tempfile::tempdir;

use crate::{apart, draw, ends_with, json, pose, truth};

#[test]
fn three_maps_become_one_and_each_pose_is_said() {
    let folder = tempdir().unwrap();
    ends_with(0, folder.path(), "apply {F}/source.yaml --transform 4,-2,30 -o {T}/moved.yaml");
    let maps = "merge {F}/target.yaml {F}/source.yaml {T}/moved.yaml -o {T}/out.yaml";
    let merged = json(0, folder.path(), &format!("{maps} --json --overlay {{T}}/o.png"));
    assert_eq!(merged["components"].as_array().unwrap().len(), 1);
    assert_eq!(merged["pairs"].as_array().unwrap().len(), 3);
    assert_eq!(merged["output"]["maps"].as_array().unwrap().len(), 3);
    let found = pose(&merged["components"][0]["poses"][1]);
    let error = apart(found, truth());
    assert!(error.0 < 0.1 && error.1 < 1.0, "{error:?}");
    assert!(fs::read(folder.path().join("o.png")).unwrap().starts_with(b"\x89PNG"));

    let again = json(0, folder.path(), &format!("{maps} --json --force --reference moved.yaml"));
    assert_eq!(again["components"][0]["poses"][0]["map"], 2, "its frame is kept");
}

#[test]
fn a_map_that_does_not_belong_is_named_and_ends_in_3() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "dot", "#");
    let maps = "merge {F}/target.yaml {F}/source.yaml {T}/dot.yaml -o {T}/out.yaml";
    let (said, _) = ends_with(3, folder.path(), maps);
    assert!(said.contains("2 of 3 maps") && said.contains("apart:"), "{said}");
    assert!(!folder.path().join("out.yaml").exists());
    let (said, _) = ends_with(3, folder.path(), &format!("{maps} --allow-partial"));
    assert!(said.contains("wrote"), "{said}");
    assert!(folder.path().join("out.yaml").exists());
}

#[test]
fn a_folder_stands_for_its_maps_and_for_nothing_else_in_it() {
    let folder = tempdir().unwrap();
    for name in ["a", "b", "c"] {
        draw(folder.path(), name, "#");
    }
    fs::write(folder.path().join("params.yaml"), "amcl:\n  image_topic: none\n").unwrap();
    let report = json(0, folder.path(), "merge {T} -o {T}/out.yaml --json");
    assert_eq!(report["maps"].as_array().unwrap().len(), 3);
    assert_eq!(report["team"]["copies"].as_array().unwrap().len(), 2, "equal files");
}

#[test]
fn what_a_team_cannot_use_is_a_usage_error() {
    let folder = tempdir().unwrap();
    let maps = "merge {F}/target.yaml {F}/source.yaml {F}/target.yaml -o {T}/out.yaml";
    for wrong in [
        "--method radon",
        "--reference nobody.yaml",
        "--prior 1,2,3 --prior-sigma 1,1",
        "--prior {F}/target.yaml=1,2,3 --prior-sigma 1,1",
        "--transform {F}/target.yaml=1,2,3",
        "--alignments {T}",
    ] {
        let (_, complained) = ends_with(2, folder.path(), &format!("{maps} {wrong}"));
        assert!(complained.contains(wrong.split(' ').next().unwrap()), "{complained}");
    }
}

#[test]
fn what_is_known_of_some_maps_holds_and_the_others_are_searched_for() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "dot", "#");
    let maps = "merge {F}/target.yaml {F}/source.yaml {T}/dot.yaml -o {T}/out.yaml --json --force";
    let given = "--transform {T}/dot.yaml=3,4,90";
    let found = json(0, folder.path(), &format!("{maps} {given}"));
    let poses = &found["components"][0]["poses"];
    assert_eq!(pose(&poses[2]), Se2::new(3.0, 4.0, std::f64::consts::FRAC_PI_2));
    let error = apart(pose(&poses[1]), truth());
    assert!(error.0 < 0.1 && error.1 < 1.0, "{error:?}");

    let near = "--prior {F}/source.yaml=-6,-5.5,-20 --prior-sigma 0.5,5";
    let found = json(0, folder.path(), &format!("{maps} {given} {near}"));
    let error = apart(pose(&found["components"][0]["poses"][1]), truth());
    assert!(error.0 < 0.1 && error.1 < 1.0, "{error:?}");
    let far = "--prior {F}/source.yaml=40,40,90 --prior-sigma 0.1,1";
    json(3, folder.path(), &format!("{maps} {given} {far}"));
}

#[test]
fn pairs_that_were_aligned_elsewhere_are_not_searched_again() {
    let folder = tempdir().unwrap();
    ends_with(0, folder.path(), "apply {F}/source.yaml --transform 4,-2,30 -o {T}/moved.yaml");
    let results = folder.path().join("found");
    fs::create_dir(&results).unwrap();
    for (index, pair) in
        ["{F}/source.yaml {F}/target.yaml", "{T}/moved.yaml {F}/target.yaml"].iter().enumerate()
    {
        let found = json(0, folder.path(), &format!("align {pair} --json"));
        fs::write(results.join(format!("{index}.json")), found.to_string()).unwrap();
    }
    let maps =
        "merge {F}/target.yaml {F}/source.yaml {T}/moved.yaml -o {T}/out.yaml --json --force";
    let here = json(0, folder.path(), maps);
    let merged = json(0, folder.path(), &format!("{maps} --alignments {{T}}/found"));
    assert_eq!(merged["pairs"].as_array().unwrap().len(), 1, "one pair is left to search");
    for map in [1, 2] {
        let found = [&here, &merged].map(|report| pose(&report["components"][0]["poses"][map]));
        let error = apart(found[0], found[1]);
        assert!(error.0 < 1e-3 && error.1 < 0.01, "{error:?}");
    }

    ends_with(
        0,
        folder.path(),
        "apply {F}/source.yaml --transform 1,0,0 -o {T}/moved.yaml --force",
    );
    let (_, complained) = ends_with(1, folder.path(), &format!("{maps} --alignments {{T}}/found"));
    assert!(complained.contains("another version of"), "{complained}");
}
