//! Maps moved and drawn.

use std::fs;

use ogm_core::{CellIndex, Occupancy};
use tempfile::tempdir;

use crate::{draw, ends_with, read};

/// Width and height, from the header of a PNG.
fn size(png: &[u8]) -> [u32; 2] {
    assert!(png.starts_with(b"\x89PNG"));
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn a_moved_map_lies_where_the_transform_says_and_has_yaw_0() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "#..\n...");
    let (said, _) =
        ends_with(0, folder.path(), "apply {T}/a.yaml --transform -1,0.5,90 -o {T}/b.yaml");
    assert!(said.starts_with("wrote ") && said.contains("2 x 3 cells of 0.05 m"), "{said}");
    let moved = read(&folder.path().join("b.yaml"));
    assert_eq!(moved.frame().map_from_grid().theta(), 0.0);
    // The wall at (0.025, 0.075) turns to (-0.075, 0.025) and moves by (-1, 0.5).
    assert_eq!(moved.at(nalgebra::Point2::new(-1.075, 0.525)), Occupancy::OCCUPIED);
    let walls = moved.cells().cells().iter().filter(|&&cell| cell == Occupancy::OCCUPIED).count();
    assert_eq!(walls, 1);
}

#[test]
fn moving_needs_force_to_overwrite_and_never_overwrites_its_input() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "#..\n...");
    ends_with(0, folder.path(), "apply {T}/a.yaml --transform 1,0,0 -o {T}/b.yaml");
    ends_with(1, folder.path(), "apply {T}/a.yaml --transform 2,0,0 -o {T}/b.yaml");
    ends_with(0, folder.path(), "apply {T}/a.yaml --transform 2,0,0 -o {T}/b.yaml --force");
    let x = read(&folder.path().join("b.yaml")).frame().map_from_grid().x();
    assert!((x - 2.0).abs() < 1e-12, "{x}");
    for output in ["{T}/a.yaml", "{T}/a", "{T}/./a.pgm"] {
        let command = format!("apply {{T}}/a.yaml --transform 2,0,0 -o {output} --force");
        let (_, complained) = ends_with(1, folder.path(), &command);
        assert!(complained.contains("never overwritten"), "{complained}");
    }
}

#[test]
fn a_map_is_drawn_cell_by_cell() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "#..?\n....\n####");
    ends_with(0, folder.path(), "view {T}/a.yaml -o {T}/a.png");
    assert_eq!(size(&fs::read(folder.path().join("a.png")).unwrap()), [4, 3]);
    ends_with(1, folder.path(), "view {T}/a.yaml -o {T}/a.png");
    ends_with(1, folder.path(), "view {T}/a.yaml -o {T}/a.pgm --force");
    let corner = CellIndex { column: 0, row: 0 };
    assert_eq!(read(&folder.path().join("a.yaml")).cells().get(corner), Some(&Occupancy::OCCUPIED));
}

#[test]
fn two_maps_are_drawn_where_the_transform_puts_them() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a", "###");
    ends_with(0, folder.path(), "view {T}/a.yaml {T}/a.yaml --transform 0.5,0,0 -o {T}/o.png");
    // Ten cells to the right of each other, and a margin of two, enlarged; a legend below.
    let [width, height] = size(&fs::read(folder.path().join("o.png")).unwrap());
    assert!(width.is_multiple_of(17) && height > width / 17 * 5, "{width} x {height}");
    let far = "view {T}/a.yaml {T}/a.yaml --transform 1e8,1e8,0 -o {T}/far.png";
    let (_, complained) = ends_with(1, folder.path(), far);
    assert!(complained.contains("too many to draw"), "{complained}");
}
