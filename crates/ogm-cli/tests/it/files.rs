//! Files with something wrong in them, and what is said about them.

use std::fs;

use crate::{apart, draw, ends_with, fixtures, header, json, pose, truth};
use serde_json::Value;
use tempfile::tempdir;

#[test]
fn what_is_wrong_is_said_in_one_sentence_with_file_and_value() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "###\n#.#");
    let origin = "origin: [0.0, 0.0, 0.0]";
    let rest = "free_thresh: 0.196";
    for (lines, complaint) in [
        (format!("resolution: nan\n{origin}\n{rest}"), "a.yaml: `resolution: nan`"),
        (format!("resolution: 0\n{origin}\n{rest}"), "a.yaml: `resolution: 0`"),
        (
            format!("resolution: 1e155\n{origin}\n{rest}"),
            "a.yaml: `resolution: 1e155`: a resolution",
        ),
        (format!("resolution: 1e-9\n{origin}\n{rest}"), "0.0001 to 1000 m are accepted"),
        (format!("resolution: 0.05\norigin: [nan, 0, 0]\n{rest}"), "a.yaml: `origin: [nan"),
        (format!("resolution: 0.05\norigin: [0, 0]\n{rest}"), "a.yaml: `origin: [0, 0]`"),
        (
            format!("resolution: 0.05\n{origin}\nfree_thresh: 0.9"),
            "`free_thresh: 0.9` must be below",
        ),
        (format!("resolution: 0.05\n{origin}"), "key `free_thresh` is missing"),
    ] {
        header(folder.path(), "a", &lines);
        for command in ["info {T}/a.yaml", "align {T}/a.yaml {F}/source.yaml --json"] {
            let (said, complained) = ends_with(1, folder.path(), command);
            assert!(said.is_empty());
            assert!(
                complained.starts_with("error: ") && complained.contains(complaint),
                "{complained}"
            );
            assert_eq!(complained.lines().count(), 1, "{complained}");
        }
    }
}

#[test]
fn files_that_are_not_there_or_are_no_maps_are_named() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "###\n#.#");
    fs::write(folder.path().join("short.pgm"), "P5 300 300 255\nabc").unwrap();
    header(folder.path(), "short", "resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.196");
    header(folder.path(), "lost", "resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.196");
    fs::write(folder.path().join("huge.pgm"), "P5 100000 100000 255\nabc").unwrap();
    header(folder.path(), "huge", "resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.196");
    for (map, complaint) in [
        ("none.yaml", "cannot read"),
        ("a.pgm", "is an image"),
        ("short.yaml", "300 × 300, 90000 pixels, but the data are 3"),
        ("lost.yaml", "the key `image` in"),
        ("huge.yaml", "exceeds the limit"),
    ] {
        for command in ["info {M}", "align {F}/target.yaml {M}", "view {M} -o {T}/x.png"] {
            let command = command.replace("{M}", &format!("{{T}}/{map}"));
            let (_, complained) = ends_with(1, folder.path(), &command);
            assert!(complained.contains(complaint), "{command}: {complained}");
            let stem = map.split('.').next().unwrap();
            assert!(complained.contains(stem), "{command}: {complained}");
        }
    }
}

#[test]
fn a_bad_tag_log_is_named_with_its_line() {
    let folder = tempdir().unwrap();
    let tags = "--tags {F}/target.yaml={T}/t.csv --tags {F}/source.yaml={T}/t.csv";
    let header = "tag_id,robot_x_m,robot_y_m,range_m\n";
    for (log, complaint) in [
        ("tag,x,y,r\n".to_owned(), "line 1"),
        (format!("{header}1,0,0,nan\n"), "line 2: range_m is \"nan\""),
        (format!("{header}1,0,0,99\n"), "--tag-range"),
    ] {
        fs::write(folder.path().join("t.csv"), log).unwrap();
        let command = format!("align {{F}}/target.yaml {{F}}/source.yaml {tags}");
        let (_, complained) = ends_with(1, folder.path(), &command);
        assert!(complained.contains("t.csv") && complained.contains(complaint), "{complained}");
    }
}

#[test]
fn outputs_that_cannot_be_written_are_an_error_before_the_work() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let maps = "merge {F}/target.yaml {F}/source.yaml";
    for output in ["{T}/none/out.yaml", "{T}/file/out.yaml", "{T}/..", "/dev/null/out.yaml"] {
        let (said, complained) = ends_with(1, folder.path(), &format!("{maps} -o {output}"));
        assert!(said.is_empty() && complained.starts_with("error: "), "{complained}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn info_tells_size_place_and_counts() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "####\n#..?");
    header(folder.path(), "a", "resolution: 0.5\norigin: [-1.5, 2, 0.5]\nfree_thresh: 0.196");
    let info = json(0, folder.path(), "info {T}/a.yaml --json");
    assert_eq!((&info["width"], &info["height"]), (&4.into(), &2.into()));
    assert_eq!(info["resolution_m"], 0.5);
    assert_eq!((&info["origin"]["x_m"], &info["origin"]["y_m"]), (&(-1.5).into(), &2.0.into()));
    let turned = info["origin"]["theta_deg"].as_f64().unwrap();
    assert!((turned - 28.64789).abs() < 1e-4);
    let counts =
        ["occupied", "free", "undecided", "unknown"].map(|class| info["cells"][class].as_u64());
    assert_eq!(counts, [5, 2, 0, 1].map(Some));
    assert_eq!(info["known_area_m2"], 1.75);
    assert_eq!((&info["mode"], &info["occupied_thresh"]), (&"trinary".into(), &0.65.into()));
    assert_eq!(info["warnings"].as_array().unwrap().len(), 0);
    let (said, _) = ends_with(0, folder.path(), "info {T}/a.yaml");
    assert!(said.contains("4 x 2 cells of 0.5 m") && said.contains("nothing suspicious"), "{said}");
}

#[test]
fn info_tells_the_known_defects_of_map_files() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "##\n.?");
    for (lines, defect) in [
        ("resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.25", "1 cells of grey 205"),
        (
            "resolution: 0.05\norigin: [1.23e+03, 0, 0]\nfree_thresh: 0.196",
            "rounded to three digits",
        ),
        (
            "resolution: 0.05\norigin: [0, 0, -nan]\nfree_thresh: 0.196",
            "yaw of the origin is not a number",
        ),
    ] {
        header(folder.path(), "a", lines);
        let info = json(0, folder.path(), "info {T}/a.yaml --json");
        let warnings = info["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].as_str().unwrap().contains(defect), "{warnings:?}");
        let (_, complained) = ends_with(3, folder.path(), "align {T}/a.yaml {T}/a.yaml");
        assert!(complained.contains("warning: ") && complained.contains(defect), "{complained}");
        let (_, complained) = ends_with(3, folder.path(), "align {T}/a.yaml {T}/a.yaml --quiet");
        assert!(complained.is_empty(), "{complained}");
    }
}

#[test]
fn a_picture_without_a_yaml_is_a_map_by_its_resolution() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "####\n#..?");
    fs::copy(folder.path().join("a.pgm"), folder.path().join("plan=b.png")).unwrap();
    for command in [
        "info {T}/plan=b.png --input {T}/plan=b.png=0.5,-1.5,2,90 --json",
        "info --input {T}/plan=b.png=0.5,-1.5,2,90 --json",
        "info --json --input={T}/plan=b.png=0.5,-1.5,2,90",
    ] {
        let info = json(0, folder.path(), command);
        assert_eq!((&info["width"], &info["resolution_m"]), (&4.into(), &0.5.into()));
        let place = ["x_m", "y_m", "theta_deg"].map(|key| info["origin"][key].as_f64().unwrap());
        assert_eq!(place, [-1.5, 2.0, 90.0], "{command}");
        assert_eq!(info["cells"]["unknown"], 1);
        assert!(info["warnings"][0].as_str().unwrap().contains("no YAML"));
    }
    let pair = json(
        0,
        folder.path(),
        "align --json {F}/target.yaml --input {F}/source.pgm=0.05 --quiet --accept 0.5",
    );
    assert!(pair["source"]["file"].as_str().unwrap().ends_with("source.pgm"));
    for wrong in ["x.png", "x.png=", "x.png=0", "x.png=0.05,1", "x.png=0.05,1,2,3,4", "=0.05"] {
        ends_with(2, folder.path(), &format!("info {{T}}/x.png --input {wrong}"));
    }
}

#[test]
fn an_image_in_the_place_of_its_yaml_is_told_what_to_write() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "##\n.?");
    fs::copy(folder.path().join("a.pgm"), folder.path().join("b.pgm")).unwrap();
    let (_, complained) = ends_with(1, folder.path(), "align {T}/a.pgm {T}/a.pgm");
    assert!(complained.contains("a.yaml") && complained.contains("a.pgm=0.05"), "{complained}");
    // Larger than any YAML.
    let (_, complained) = ends_with(1, folder.path(), "align {F}/target.pgm {F}/source.pgm");
    assert!(complained.contains("target.yaml") && complained.contains("--input "), "{complained}");
    let (_, complained) = ends_with(1, folder.path(), "info {T}/b.pgm");
    assert!(!complained.contains("b.yaml") && complained.contains("--input "), "{complained}");
}

/// Nav2 saves with a `free_thresh` that makes its own unknown free; a pixel painted white afterwards
/// must not bring that about.
#[test]
fn a_map_saved_by_nav2_and_painted_into_merges_as_what_was_saved() {
    let folder = tempdir().unwrap();
    for map in ["target", "source"] {
        let mut image = fs::read(fixtures().join(format!("{map}.pgm"))).unwrap();
        let painted = image.iter().rposition(|&pixel| pixel == 205).unwrap();
        image[painted] = 255;
        fs::write(folder.path().join(format!("{map}.pgm")), image).unwrap();
        let yaml = fs::read_to_string(fixtures().join(format!("{map}.yaml"))).unwrap();
        let nav2 = yaml.replace("free_thresh: 0.196", "free_thresh: 0.25");
        assert_ne!(nav2, yaml);
        fs::write(folder.path().join(format!("{map}.yaml")), nav2).unwrap();
    }
    let info = |map: &str| json(0, folder.path(), &format!("info {map} --json"));
    for map in ["target", "source"] {
        let [saved, painted] = ["{F}", "{T}"].map(|place| info(&format!("{place}/{map}.yaml")));
        let unknown = |info: &Value| info["cells"]["unknown"].as_u64().unwrap();
        assert_eq!(unknown(&painted) + 1, unknown(&saved));
        let warning = painted["warnings"][0].as_str().unwrap();
        assert!(warning.contains("cells of grey 205 read as unknown"), "{warning}");
    }
    let merge = "merge {T}/target.yaml {T}/source.yaml -o {T}/out.yaml";
    let (_, complained) = ends_with(0, folder.path(), merge);
    assert_eq!(complained.matches("read as unknown although free_thresh 0.25").count(), 2);
    let pair = &json(0, folder.path(), &format!("{merge} --force --json"))["pairs"][0];
    assert_eq!(pair["verdict"], "merged");
    let error = apart(pose(&pair["target_from_source"]), truth());
    assert!(error.0 < 0.05 && error.1 < 0.5, "{error:?}");
}

/// What `field/cases` of the kind showed, on files of our own.
#[test]
fn maps_that_were_moved_edited_or_saved_by_others_are_read_with_a_warning() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "###\n#.?");
    let rest = "resolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.196\n";
    let keys = format!("negate: 0\noccupied_thresh: 0.65\n{rest}");
    for (yaml, part) in [
        (format!("image: /opt/robot/a.pgm\n{keys}"), "write image: a.pgm"),
        (format!("image: a.pgm\n{keys}resolution: 0.05\n"), "`resolution` stands twice"),
        (format!("image: a.pgm\nmode: [0,0,10]\n{keys}"), "write mode: trinary"),
        (format!("\u{feff}image: a.pgm\n{keys}"), "byte order mark"),
    ] {
        fs::write(folder.path().join("m.yaml"), yaml).unwrap();
        let info = json(0, folder.path(), "info {T}/m.yaml --json");
        assert_eq!(info["cells"]["occupied"], 4);
        let warnings = info["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].as_str().unwrap().contains(part), "{warnings:?}");
    }
    fs::write(folder.path().join("a.pgm"), "version https://git-lfs.github.com/spec/v1\n").unwrap();
    let (_, complained) = ends_with(1, folder.path(), "info {T}/m.yaml");
    assert!(complained.contains("a.pgm") && complained.contains("git lfs pull"), "{complained}");
}
