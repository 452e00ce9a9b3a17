//! Maps out of bags.

use std::collections::BTreeMap;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use ogm_core::{GridFrame, OccupancyGrid, Se2};
use ogm_io::ros::{Header, OccupancyGridMessage, to_cdr};
use ogm_io::{
    BagError, BagTopic, BagWriter, IoError, MapFiles, OCCUPANCY_GRID_DEFINITION, read_map,
};

fn map(ascii: &str) -> OccupancyGrid {
    let frame = GridFrame::new(0.05, Se2::new(1.0, -2.0, 0.5)).unwrap();
    OccupancyGrid::from_ascii(frame, ascii).unwrap()
}

/// A bag whose map has one cell more each second, and the folder that `metadata` makes of it.
fn bag() -> Vec<u8> {
    let mut bag = BagWriter::new(Cursor::new(Vec::new())).unwrap();
    let kind = OccupancyGridMessage::TYPE;
    let mut topic =
        |name| bag.add(&BagTopic { name, kind, definition: OCCUPANCY_GRID_DEFINITION }).unwrap();
    let (map_topic, other) = (topic("/robot1/map"), topic("/robot2/map"));
    for second in 1..=3_u64 {
        let ascii = "#".repeat(usize::try_from(second).unwrap());
        let message = OccupancyGridMessage::from_map(Header::default(), &map(&ascii)).unwrap();
        let bytes = to_cdr(&message).unwrap();
        let time_ns = (1_000 + second) * 1_000_000_000;
        bag.write(map_topic, time_ns, &bytes).unwrap();
        bag.write(other, time_ns, &bytes).unwrap();
    }
    bag.finish("bag_0.mcap").unwrap().0.into_inner()
}

fn named(bag: &Path, map: &str) -> PathBuf {
    PathBuf::from(format!("{}:{map}", bag.display()))
}

#[test]
fn the_last_map_of_a_topic_or_that_of_a_time_is_read_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("team_0.mcap");
    fs::write(&file, bag()).unwrap();
    for bag in [&file, folder.path()] {
        for (name, cells) in [("/robot1/map", 3), ("/robot1/map@1.5", 2), ("/robot1/map@0", 1)] {
            let read = read_map(&named(bag, name)).unwrap().map;
            assert_eq!(read.width(), cells, "{name}");
            assert_eq!(read.frame().resolution(), 0.05);
            let error = read.frame().map_from_grid().between(&Se2::new(1.0, -2.0, 0.5));
            assert!(error.log().norm() < 1e-12);
            let (size, frame) = MapFiles::size(&named(bag, name)).unwrap();
            assert_eq!((size.width, frame), (cells, *read.frame()));
        }
    }
}

#[test]
fn a_topic_without_maps_is_an_error_that_names_those_with() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("team.mcap");
    fs::write(&file, bag()).unwrap();
    let error = read_map(&named(&file, "/map")).unwrap_err();
    assert!(matches!(error, IoError::Bag { cause: BagError::NoMap { .. }, .. }));
    assert!(error.to_string().contains("/robot1/map, /robot2/map"), "{error}");
    let text = folder.path().join("text.mcap");
    fs::write(&text, "image: map.pgm").unwrap();
    let error = read_map(&named(&text, "/map")).unwrap_err();
    assert!(matches!(error, IoError::Bag { cause: BagError::NotABag, .. }));
    assert!(read_map(&named(&folder.path().join("none.mcap"), "/map")).is_err());
}

/// A bag of one map, as `ros2 bag record` writes it unless told to compress.
fn plain_bag() -> Vec<u8> {
    let options = mcap::WriteOptions::new().compression(None).calculate_chunk_crcs(false);
    let mut bag = options.create(Cursor::new(Vec::new())).unwrap();
    let definition = OCCUPANCY_GRID_DEFINITION.as_bytes();
    let schema = bag.add_schema(OccupancyGridMessage::TYPE, "ros2msg", definition).unwrap();
    let channel_id = bag.add_channel(schema, "/map", "cdr", &BTreeMap::new()).unwrap();
    let header = MessageHeader { channel_id, sequence: 0, log_time: 7, publish_time: 7 };
    let message = OccupancyGridMessage::from_map(Header::default(), &map("#.\n?.")).unwrap();
    bag.write_to_known_channel(&header, &to_cdr(&message).unwrap()).unwrap();
    bag.finish().unwrap();
    bag.into_inner().into_inner()
}

#[test]
fn a_bit_that_fell_over_anywhere_in_a_bag_is_an_error_or_no_matter() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plain.mcap");
    let whole = plain_bag();
    let map = named(&file, "/map");
    fs::write(&file, &whole).unwrap();
    assert_eq!(read_map(&map).unwrap().map.to_ascii(), "#.\n?.\n");
    let mut overlong = 0;
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x40;
        fs::write(&file, &damaged).unwrap();
        if let Err(error) = read_map(&map) {
            overlong += usize::from(error.to_string().contains("is longer than its chunk"));
        }
    }
    assert!(overlong >= 8, "{overlong}");
}

#[test]
fn other_records_of_a_bag_may_be_too_short() {
    const ATTACHMENT: u8 = 9;
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plain.mcap");
    let mut bytes = plain_bag();
    let behind_magic = 8;
    for length in 0..40_u8 {
        let head = u64::from(length).to_le_bytes();
        let record = [&[ATTACHMENT][..], &head, &vec![0; usize::from(length)]];
        bytes.splice(behind_magic..behind_magic, record.concat());
    }
    fs::write(&file, &bytes).unwrap();
    assert_eq!(read_map(&named(&file, "/map")).unwrap().map.to_ascii(), "#.\n?.\n");
}

#[test]
fn a_bag_cut_anywhere_is_an_error_and_never_an_older_map() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("team.mcap");
    let whole = bag();
    for length in (0..whole.len()).step_by(7) {
        fs::write(&file, &whole[..length]).unwrap();
        assert!(read_map(&named(&file, "/robot1/map")).is_err(), "{length} bytes");
    }
}
