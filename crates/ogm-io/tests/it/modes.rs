//! Trinary, scale and raw, as `map_server` defines them.

use image::ExtendedColorType;
use ogm_core::{CellIndex, Occupancy, OccupancyGrid};
use ogm_io::{MapMode, MapWarning, ReadOptions};

use crate::images::png;
use crate::{header_with, picture, read};

fn probabilities(map: &OccupancyGrid) -> Vec<Option<f64>> {
    map.cells().cells().iter().map(|cell| cell.probability()).collect()
}

#[test]
fn the_first_image_row_is_the_highest_grid_row() {
    let (map, _) = read(&[], b"P2 1 2 255 0 254").unwrap();
    let lowest = CellIndex { column: 0, row: 0 };
    assert_eq!(map.cells().get(lowest), Some(&Occupancy::FREE));
}

#[test]
fn thresholds_are_strict() {
    // Grey 51 is 0.8 occupied, grey 204 is 0.2.
    let image = b"P2 2 1 255 51 204";
    let at = [("occupied_thresh", "0.8"), ("free_thresh", "0.2")];
    let beside = [("occupied_thresh", "0.7999"), ("free_thresh", "0.2001")];
    assert_eq!(picture(&at, image), "??\n");
    assert_eq!(picture(&beside, image), "#.\n");
}

#[test]
fn negate_inverts() {
    let image = b"P2 3 1 255 0 128 255";
    assert_eq!(picture(&[], image), "#?.\n");
    for yes in ["1", "true", "yes", "On"] {
        assert_eq!(picture(&[("negate", yes)], image), ".?#\n", "{yes}");
    }
    for no in ["0", "false", "no", "off"] {
        assert_eq!(picture(&[("negate", no)], image), "#?.\n", "{no}");
    }
    let scale =
        [("negate", "1"), ("mode", "scale"), ("occupied_thresh", "1"), ("free_thresh", "0")];
    let (map, _) = read(&scale, b"P2 2 1 255 0 255").unwrap();
    assert_eq!(probabilities(&map), [Some(0.0), Some(1.0)]);
}

#[test]
fn scale_is_linear_between_the_thresholds() {
    let keys = [("mode", "scale"), ("occupied_thresh", "0.8"), ("free_thresh", "0.2")];
    assert_eq!(header_with(&keys).0.mode, MapMode::Scale);
    // Occupied fractions 1, 0.8, 0.6, 0.5, 0.2, 0.
    let (map, warnings) = read(&keys, b"P2 6 1 10 0 2 4 5 8 10").unwrap();
    let expected = [1.0, 1.0, 2.0 / 3.0, 0.5, 0.0, 0.0];
    for (read, expected) in probabilities(&map).into_iter().zip(expected) {
        assert!((read.unwrap() - expected).abs() <= 0.5 / 254.0 + 1e-12, "{read:?} {expected}");
    }
    assert_eq!(warnings, []);
}

#[test]
fn scale_reads_what_is_not_opaque_as_unknown() {
    let file = png(3, 1, &[0, 255, 0, 254, 255, 0], ExtendedColorType::La8);
    let (map, _) = read(&[("mode", "scale")], &file).unwrap();
    assert_eq!(probabilities(&map), [Some(1.0), None, None]);
}

#[test]
fn raw_pixels_are_percentages() {
    let keys = [("mode", "raw")];
    let (map, warnings) = read(&keys, b"P2 5 1 255 0 50 100 101 255").unwrap();
    assert_eq!(probabilities(&map), [Some(0.0), Some(0.5), Some(1.0), None, None]);
    assert_eq!(warnings, []);
    let (same, warnings) =
        read(&[("mode", "raw"), ("negate", "1")], b"P2 5 1 255 0 50 100 101 255").unwrap();
    assert_eq!((same, warnings), (map, vec![MapWarning::NegateIgnored]));
}

#[test]
fn alpha_in_a_trinary_map_is_left_out_unless_asked_for() {
    // Opaque wall, opaque unknown, opaque free, transparent black.
    let samples = [0, 255, 205, 255, 254, 255, 0, 0];
    let file = png(4, 1, &samples, ExtendedColorType::La8);
    let (map, warnings) = read(&[], &file).unwrap();
    assert_eq!(map.to_ascii(), "#?.?\n");
    assert_eq!(warnings, [MapWarning::AlphaLeftOut { translucent: 1 }]);

    let averaged = ReadOptions { averaged_alpha: true, ..ReadOptions::default() };
    let (map, warnings) = header_with(&[]).0.read_image(file, &averaged).unwrap();
    // Both loaders see four channels: (3 · 205 + 255)/4 = 217 is free, (3 · 0 + 255)/4 = 64 occupied.
    assert_eq!(map.to_ascii(), "#..#\n");
    assert_eq!(warnings, [MapWarning::AlphaAveraged]);
}
