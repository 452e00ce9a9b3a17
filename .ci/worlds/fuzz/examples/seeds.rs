//! Writes good files of every kind into the folders from which the fuzzers start.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::io::Cursor;
use std::path::Path;

use image::codecs::bmp::BmpEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder};
use ogm_core::{GridFrame, OccupancyGrid, Se2};
use ogm_io::ros::{Header, OccupancyGridMessage, to_cdr};
use mcap::records::MessageHeader;
use ogm_io::{OCCUPANCY_GRID_DEFINITION, TAG_LOG_HEADER};
use ogm_merge::{Hypothesis, MergeSession, SessionParams};
use rusqlite::Connection;

type Done<T = ()> = Result<T, Box<dyn Error>>;

const SIDE: u32 = 12;

fn main() -> Done {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/corpus");
    let put = |kind: &str, name: &str, bytes: &[u8]| -> Done {
        let folder = corpus.join(kind);
        fs::create_dir_all(&folder)?;
        Ok(fs::write(folder.join(name), bytes)?)
    };
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../fixtures/plan-a");

    let yaml = fs::read_to_string(fixtures.join("target.yaml"))?;
    let with_anchor = format!("{yaml}mode: trinary\nx: {{a: [1, &b 2], c: *b}}\n");
    let utf16: Vec<u8> = with_anchor.encode_utf16().flat_map(u16::to_le_bytes).collect();
    put("header", "plain", yaml.as_bytes())?;
    put("header", "anchor", with_anchor.as_bytes())?;
    put("header", "utf16", &utf16)?;

    for (name, bytes) in images()? {
        // Trinary; raw; and trinary with the file's size looked up.
        for how in [0, 2, 0b1110_0000] {
            put("image", &format!("{name}-{how}"), &[&[how], &bytes[..]].concat())?;
        }
    }

    let few = "7, 1.5, -0.25, 2.125\n8,0,0,3\n\n9,1e3,2,0\n";
    put("tags", "few", format!("{TAG_LOG_HEADER}\n{few}").as_bytes())?;
    let log = fs::read_to_string(fixtures.join("target.tags.csv"))?;
    let start: Vec<&str> = log.lines().take(20).collect();
    put("tags", "log", start.join("\n").as_bytes())?;

    let frame = GridFrame::new(0.05, Se2::new(1.0, -2.0, 0.5))?;
    let map = OccupancyGrid::from_ascii(frame, "#####\n#...#\n#.?.#\n#####")?;
    let message = to_cdr(&OccupancyGridMessage::from_map(Header::default(), &map)?)?;
    put("message", "map", &message)?;
    put("bag", "mcap", &mcap(&message)?)?;
    put("bag", "sqlite", &sqlite(&message)?)?;

    let graph = "# two poses\nVERTEX_SE2 10 0 0 0\nVERTEX_SE2 7 1 0 1.5\n\n\
                 EDGE_SE2 10 7 1.0 0.1 1.57 400 0 0 100 0 2500\nFIX 10\n\
                 VERTEX_SE2 3 2 1 -1\nEDGE_SE2 7 3 1 0 -2 100 1 0 100 0 900\n\
                 EDGE_SE2 3 10 -2 1 1 100 0 2 80 0 900\n";
    put("graph", "triangle", graph.as_bytes())?;

    let hypothesis = |x: f64| Hypothesis {
        target_from_source: Se2::new(x, -0.5, 0.3),
        probability: Some(0.9),
        score: 4.0,
        covariance: Some(nalgebra::Matrix3::identity() * 1e-4),
        bend_m: Some(0.02),
    };
    let both = [hypothesis(0.0), hypothesis(2.0)];
    let pairs = [(0, 1, &both[..]), (1, 2, &both[1..]), (0, 2, &both[1..])];
    put("alignments", "three", &serde_json::to_vec(&pairs)?)?;

    let mut session = MergeSession::new(SessionParams::default())?;
    for robot in ["a", "b"] {
        session.update(robot, &map, &())?;
    }
    put("session", "two", &serde_json::to_vec(&session.save())?)?;
    Ok(())
}

/// A small map in every format and kind of pixel that is read.
fn images() -> Done<Vec<(&'static str, Vec<u8>)>> {
    let greys: Vec<u8> = (0..SIDE * SIDE).map(|at| [0, 205, 254][at as usize % 3]).collect();
    let colours: Vec<u8> = greys.iter().flat_map(|&grey| [grey; 3]).collect();
    let wide: Vec<u8> = greys.iter().flat_map(|&grey| [grey; 2]).collect();
    let bits: Vec<u8> = greys.iter().map(|grey| grey & 1).collect();
    let plain = |magic: &str, max: &str, samples: &[u8]| {
        let numbers: String = samples.iter().map(|sample| format!(" {sample}")).collect();
        format!("{magic}\n# a map\n{SIDE} {SIDE}{max}\n{numbers}\n").into_bytes()
    };
    let raw = |magic: &str, max: &str, samples: &[u8]| {
        [format!("{magic} {SIDE} {SIDE}{max}\n").as_bytes(), samples].concat()
    };
    let png = |samples: &[u8], colour| -> Done<Vec<u8>> {
        let mut file = Vec::new();
        PngEncoder::new(&mut file).write_image(samples, SIDE, SIDE, colour)?;
        Ok(file)
    };
    let bmp = |samples: &[u8], colour| -> Done<Vec<u8>> {
        let mut file = Vec::new();
        BmpEncoder::new(&mut file).write_image(samples, SIDE, SIDE, colour)?;
        Ok(file)
    };
    let tiff = |samples: &[u8], colour| -> Done<Vec<u8>> {
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file).write_image(samples, SIDE, SIDE, colour)?;
        Ok(file.into_inner())
    };
    let mut jpeg = Vec::new();
    JpegEncoder::new(&mut jpeg).write_image(&greys, SIDE, SIDE, ExtendedColorType::L8)?;
    Ok(vec![
        ("p1", plain("P1", "", &bits)),
        ("p2", plain("P2", " 255", &greys)),
        ("p3", plain("P3", " 255", &colours)),
        ("p4", raw("P4", "", &[0xa5; 2 * SIDE as usize])),
        ("p5", raw("P5", " 255", &greys)),
        ("p5-16", raw("P5", " 65535", &wide)),
        ("p6", raw("P6", " 255", &colours)),
        ("png", png(&greys, ExtendedColorType::L8)?),
        ("png-alpha", png(&wide, ExtendedColorType::La8)?),
        ("png-16", png(&wide, ExtendedColorType::L16)?),
        ("bmp", bmp(&greys, ExtendedColorType::L8)?),
        ("bmp-24", bmp(&colours, ExtendedColorType::Rgb8)?),
        ("jpeg", jpeg),
        ("tiff", tiff(&greys, ExtendedColorType::L8)?),
        ("tiff-24", tiff(&colours, ExtendedColorType::Rgb8)?),
    ])
}

/// Not compressed: what is compressed and damaged is refused before it is looked at.
fn mcap(message: &[u8]) -> Done<Vec<u8>> {
    let options = mcap::WriteOptions::new().compression(None).calculate_chunk_crcs(false);
    let mut bag = options.create(Cursor::new(Vec::new()))?;
    let kind = OccupancyGridMessage::TYPE;
    let schema = bag.add_schema(kind, "ros2msg", OCCUPANCY_GRID_DEFINITION.as_bytes())?;
    for (sequence, topic) in (0..).zip(["/robot1/map", "/robot2/map"]) {
        let channel_id = bag.add_channel(schema, topic, "cdr", &BTreeMap::new())?;
        let (log_time, publish_time) = (1_000_000_000, 1_000_000_000);
        let header = MessageHeader { channel_id, sequence, log_time, publish_time };
        bag.write_to_known_channel(&header, message)?;
    }
    bag.finish()?;
    Ok(bag.into_inner().into_inner())
}

/// As `ros2 bag` lays its tables out.
fn sqlite(message: &[u8]) -> Done<Vec<u8>> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("bag.db3");
    let bag = Connection::open(&file)?;
    bag.execute_batch(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, \
         serialization_format TEXT, offered_qos_profiles TEXT); \
         CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, \
         data BLOB); \
         INSERT INTO topics VALUES(1, '/robot1/map', 'nav_msgs/msg/OccupancyGrid', 'cdr', '');",
    )?;
    bag.execute("INSERT INTO messages VALUES(1, 1, 1000000000, ?1)", [message])?;
    drop(bag);
    Ok(fs::read(file)?)
}
