//! What is written comes back.

use ogm_core::{CellClass, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_io::{CellEncoding, WriteOptions, read_map, write_map};
use proptest::prelude::{ProptestConfig, Strategy, any, prop_assert, prop_assert_eq, proptest};
use std::f64::consts::PI;

use crate::map;

const PROBABILITIES: WriteOptions =
    WriteOptions { overwrite: false, encoding: CellEncoding::Probabilities };

fn any_map() -> impl Strategy<Value = OccupancyGrid> {
    let frame = (0.001_f64..2.0, -1e5_f64..1e5, -1e5_f64..1e5, -PI..PI).prop_map(
        |(resolution, x, y, yaw)| GridFrame::new(resolution, Se2::new(x, y, yaw)).unwrap(),
    );
    let cells = (1_usize..9, 1_usize..9).prop_flat_map(|(width, height)| {
        proptest::collection::vec(any::<u8>(), width * height).prop_map(move |bytes| {
            let cells = bytes.into_iter().map(Occupancy::from_byte).collect();
            Grid::new(width, height, cells).unwrap()
        })
    });
    (frame, cells).prop_map(|(frame, cells)| OccupancyGrid::new(frame, cells))
}

fn assert_same_place(read: &GridFrame, written: &GridFrame) {
    let (read_pose, pose) = (read.map_from_grid(), written.map_from_grid());
    assert_eq!(read.resolution(), written.resolution());
    assert_eq!(read_pose.translation(), pose.translation());
    assert!((read_pose.theta() - pose.theta()).abs() < 1e-15 * PI, "{pose:?}");
}

proptest! {
    // Each case waits for the disk.
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn classes_and_place_survive(map in any_map()) {
        let folder = tempfile::tempdir().unwrap();
        let yaml = folder.path().join("map.yaml");
        write_map(&yaml, &map, &WriteOptions::default()).unwrap();
        let loaded = read_map(&yaml).unwrap();
        prop_assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        assert_same_place(loaded.map.frame(), map.frame());
        let thresholds = ClassThresholds::default();
        let expected = map.cells().map(|&cell| match thresholds.classify(cell) {
            CellClass::Occupied => Occupancy::OCCUPIED,
            CellClass::Free => Occupancy::FREE,
            CellClass::Undecided | CellClass::Unknown => Occupancy::UNKNOWN,
        });
        prop_assert_eq!(loaded.map.cells(), &expected);
    }

    #[test]
    fn probabilities_survive_bit_for_bit(map in any_map()) {
        let folder = tempfile::tempdir().unwrap();
        let yaml = folder.path().join("map.yaml");
        write_map(&yaml, &map, &PROBABILITIES).unwrap();
        let loaded = read_map(&yaml).unwrap();
        assert_same_place(loaded.map.frame(), map.frame());
        prop_assert_eq!(loaded.map.cells(), map.cells());
    }
}

#[test]
fn every_storable_probability_survives() {
    let cells = (0..=255).map(Occupancy::from_byte).collect();
    let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
    let map = OccupancyGrid::new(frame, Grid::new(32, 8, cells).unwrap());
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    write_map(&yaml, &map, &PROBABILITIES).unwrap();
    assert_eq!(read_map(&yaml).unwrap().map, map);
}

#[test]
fn equal_and_opposite_evidence_is_written_as_unknown() {
    let mut map = map("##\n..");
    map.cells_mut().cells_mut()[0] = Occupancy::from_probability(0.5);
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("map.yaml");
    write_map(&yaml, &map, &WriteOptions::default()).unwrap();
    let image = std::fs::read(folder.path().join("map.pgm")).unwrap();
    assert_eq!(image, b"P5\n2 2\n255\n\x00\x00\xcd\xfe");
}

#[test]
fn the_file_is_what_other_tools_expect() {
    let frame = GridFrame::new(0.1, Se2::new(12_345.123_456_789, -1e-9, 0.0)).unwrap();
    let map = OccupancyGrid::from_ascii(frame, "#").unwrap();
    let folder = tempfile::tempdir().unwrap();
    write_map(&folder.path().join("lab.yaml"), &map, &WriteOptions::default()).unwrap();
    let text = std::fs::read_to_string(folder.path().join("lab.yaml")).unwrap();
    assert_eq!(
        text,
        "image: lab.pgm\nmode: trinary\nresolution: 0.1\n\
         origin: [12345.123456789, -0.000000001, 0.0]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    );
}

#[test]
fn names_that_yaml_could_misread_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let map = map("#.\n?.");
    for name in ["it's a map: #1", "007", "~", "- x", "карта", "*a", "true", "{a}", "a.b"] {
        let yaml = folder.path().join(format!("{name}.yaml"));
        write_map(&yaml, &map, &WriteOptions::default()).unwrap();
        assert_eq!(read_map(&yaml).unwrap().map.cells(), map.cells(), "{name}");
    }
}
