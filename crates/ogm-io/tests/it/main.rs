//! Maps and tag logs through real files and arbitrary bytes.

#![expect(clippy::disallowed_methods, reason = "the subject is files")]
#![expect(clippy::unwrap_used, reason = "everything here is test code")]

mod atomic;
#[cfg(feature = "bags")]
mod bags;
mod defects;
mod elsewhere;
mod formats;
mod images;
mod malformed;
mod modes;
mod mutants;
mod round_trip;
mod tags;
mod writers;

use ogm_core::{GridFrame, OccupancyGrid, Se2};
use ogm_io::{MapHeader, MapImageError, MapWarning, ReadOptions};

/// A map YAML with some keys replaced, added, or (value empty) removed.
fn yaml_with(changes: &[(&str, &str)]) -> String {
    let mut keys = vec![
        ("image", "map.pgm"),
        ("resolution", "0.05"),
        ("origin", "[-1.0, 2.0, 0.0]"),
        ("negate", "0"),
        ("occupied_thresh", "0.65"),
        ("free_thresh", "0.196"),
    ];
    for &(key, value) in changes {
        match keys.iter_mut().find(|(known, _)| *known == key) {
            Some(entry) => entry.1 = value,
            None => keys.push((key, value)),
        }
    }
    keys.iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(key, value)| format!("{key}: {value}\n"))
        .collect()
}

fn header_with(changes: &[(&str, &str)]) -> (MapHeader, Vec<MapWarning>) {
    MapHeader::parse(yaml_with(changes).as_bytes()).unwrap()
}

type ReadImage = Result<(OccupancyGrid, Vec<MapWarning>), MapImageError>;

fn read(changes: &[(&str, &str)], image: &[u8]) -> ReadImage {
    header_with(changes).0.read_image(image.to_vec(), &ReadOptions::default())
}

/// The picture of an image that must be readable.
fn picture(changes: &[(&str, &str)], image: &[u8]) -> String {
    read(changes, image).unwrap().0.to_ascii()
}

fn map(picture: &str) -> OccupancyGrid {
    OccupancyGrid::from_ascii(GridFrame::new(0.05, Se2::new(-1.25, 3.5, 0.3)).unwrap(), picture)
        .unwrap()
}
