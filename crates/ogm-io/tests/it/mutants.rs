//! Damaged files: whatever is done to one, reading it ends, and ends without a panic.
//!
//! Each mutant is a good file, several of its bytes changed at random; the same ones in every run.
//! `OGM_MUTANTS=1000000 cargo test --release -p ogm-io mutants -- --ignored` runs longer; under
//! `ulimit -v 1500000` an allocation that a header talked the reader into is a failure, too.

use std::io::Cursor;

use image::codecs::bmp::BmpEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder};
use ogm_io::{MapHeader, MapSize, ReadOptions, TAG_LOG_HEADER, parse_tags};

use crate::images::png;
use crate::malformed::checksum;
use crate::{header_with, yaml_with};

const SIDE: u32 = 12;

/// The generator SplitMix64: what decides must be the same everywhere.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end.max(1) as u64).unwrap()
    }

    fn mutant(&mut self, good: &[u8]) -> Vec<u8> {
        const WORDS: [&[u8]; 14] = [
            b"-1",
            b"99999999999999999999",
            b"1e309",
            b"nan",
            b"[",
            b"{",
            b"#",
            b"\n",
            b"\0",
            b"\xff\xff\xff\xff",
            b"\x7f\xff\xff\xff",
            b"\x00\x00\x00\x00",
            b"&a",
            b"\xc3\x28",
        ];
        let mut bytes = good.to_vec();
        for _ in 0..=self.below(6) {
            let at = self.below(bytes.len() + 1);
            let end = (at + 1 + self.below(8)).min(bytes.len());
            match self.below(7) {
                0 => bytes.truncate(at),
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let copy = bytes[at..end].to_vec();
                    let there = self.below(bytes.len() + 1);
                    bytes.splice(there..there, copy);
                }
                3 => drop(bytes.splice(at..end, WORDS[self.below(WORDS.len())].iter().copied())),
                4 => drop(bytes.splice(at..at, WORDS[self.below(WORDS.len())].iter().copied())),
                // Heads are where sizes are.
                5 if !bytes.is_empty() => {
                    let at = self.below(bytes.len().min(64));
                    bytes[at] = self.next().to_le_bytes()[0];
                }
                _ if at < bytes.len() => bytes[at] ^= 1 << self.below(8),
                _ => {}
            }
        }
        bytes
    }
}

/// How many mutants of each file: few, or as many as are asked for.
fn many() -> usize {
    std::env::var("OGM_MUTANTS").map_or(100_000, |count| count.parse().unwrap())
}

fn images() -> Vec<(&'static str, Vec<u8>)> {
    let greys: Vec<u8> = (0..SIDE * SIDE).map(|at| [0, 205, 254][at as usize % 3]).collect();
    let colours: Vec<u8> = greys.iter().flat_map(|&grey| [grey; 3]).collect();
    let wide: Vec<u8> = greys.iter().flat_map(|&grey| [grey; 2]).collect();
    let bmp = |samples: &[u8], colour| {
        let mut file = Vec::new();
        BmpEncoder::new(&mut file).write_image(samples, SIDE, SIDE, colour).unwrap();
        file
    };
    let tiff = |samples: &[u8], colour| {
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file).write_image(samples, SIDE, SIDE, colour).unwrap();
        file.into_inner()
    };
    let mut jpeg = Vec::new();
    JpegEncoder::new(&mut jpeg).write_image(&greys, SIDE, SIDE, ExtendedColorType::L8).unwrap();
    let plain = |magic: &str, max: &str, samples: &[u8]| {
        let numbers: String = samples.iter().map(|sample| format!(" {sample}")).collect();
        format!("{magic}\n# a map\n{SIDE} {SIDE}{max}\n{numbers}\n").into_bytes()
    };
    let raw = |magic: &str, max: &str, samples: &[u8]| {
        [format!("{magic} {SIDE} {SIDE}{max}\n").as_bytes(), samples].concat()
    };
    let bits: Vec<u8> = greys.iter().map(|grey| grey & 1).collect();
    vec![
        ("P1", plain("P1", "", &bits)),
        ("P2", plain("P2", " 255", &greys)),
        ("P3", plain("P3", " 255", &colours)),
        ("P4", raw("P4", "", &[0xa5; 2 * SIDE as usize])),
        ("P5", raw("P5", " 255", &greys)),
        ("P5 of 16 bit", raw("P5", " 65535", &wide)),
        ("P6", raw("P6", " 255", &colours)),
        ("PNG", png(SIDE, SIDE, &greys, ExtendedColorType::L8)),
        ("PNG with alpha", png(SIDE, SIDE, &wide, ExtendedColorType::La8)),
        ("PNG of 16 bit", png(SIDE, SIDE, &wide, ExtendedColorType::L16)),
        ("BMP", bmp(&greys, ExtendedColorType::L8)),
        ("BMP of 24 bit", bmp(&colours, ExtendedColorType::Rgb8)),
        ("JPEG", jpeg),
        ("TIFF", tiff(&greys, ExtendedColorType::L8)),
        ("TIFF of 24 bit", tiff(&colours, ExtendedColorType::Rgb8)),
    ]
}

/// Gives the chunks of a PNG the checksums that they should have, so that what is in them is read.
fn mend(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes(length.try_into().unwrap()) as usize;
        let Some(sum) =
            bytes.get(at + 4..at.saturating_add(8).saturating_add(length)).map(checksum)
        else {
            return;
        };
        let Some(place) = bytes.get_mut(at + 8 + length..at + 12 + length) else { return };
        place.copy_from_slice(&sum.to_be_bytes());
        at += 12 + length;
    }
}

fn damage_images(mutants: usize) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image");
    for (name, good) in images() {
        let mut dice = Dice(good.len() as u64);
        let headers = ["trinary", "scale", "raw"].map(|mode| header_with(&[("mode", mode)]).0);
        assert!(headers[0].read_image(good.clone(), &ReadOptions::default()).is_ok(), "{name}");
        for count in 0..mutants {
            let mut mutant = dice.mutant(&good);
            if name.starts_with("PNG") && dice.below(4) > 0 {
                mend(&mut mutant);
            }
            if name == "JPEG" && dice.below(4) > 0 {
                mutant.extend([0xff, 0xd9]);
            }
            if count % 50 == 0 {
                std::fs::write(&path, &mutant).unwrap();
                let _ = MapSize::of_image(&path);
            }
            let options = ReadOptions { averaged_alpha: count % 2 == 0, literal_205: false };
            if let Ok((map, _)) = headers[count % 3].read_image(mutant, &options) {
                assert!(map.width() > 0 && map.height() > 0, "{name}");
            }
        }
    }
}

fn damage_texts(mutants: usize) {
    let yaml = yaml_with(&[("mode", "trinary"), ("x", "{a: [1, &b 2], c: *b}")]);
    let utf16: Vec<u8> = yaml.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let mut dice = Dice(1);
    for good in [yaml.as_bytes(), &utf16] {
        for _ in 0..mutants {
            if let Ok((header, _)) = MapHeader::parse(&dice.mutant(good)) {
                assert!(header.frame.map_from_grid().is_finite());
                assert!(header.free_thresh < header.occupied_thresh);
            }
        }
    }
    let tags = format!("{TAG_LOG_HEADER}\n7, 1.5, -0.25, 2.125\n8,0,0,3\n\n9,1e3,2,0\n");
    for _ in 0..mutants {
        for reading in parse_tags(&dice.mutant(tags.as_bytes())).into_iter().flatten() {
            assert!(reading.range.is_finite() && reading.range >= 0.0);
        }
    }
}

#[test]
fn damaged_images_and_texts_are_read_or_refused() {
    damage_images(400);
    damage_texts(2000);
}

#[test]
#[ignore = "minutes"]
fn many_damaged_images_are_read_or_refused() {
    damage_images(many());
}

#[test]
#[ignore = "minutes"]
fn many_damaged_texts_are_read_or_refused() {
    damage_texts(10 * many());
}
