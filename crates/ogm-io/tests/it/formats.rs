//! One picture in every format that maps are found in.

use std::io::Cursor;

use image::codecs::bmp::BmpEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder};
use ogm_io::{MapImageError, MapWarning};

use crate::{picture, read};

const PICTURE: &str = "#.\n.?\n?#\n";
const GREYS: [u8; 6] = [0, 254, 254, 205, 205, 0];

fn rgb() -> Vec<u8> {
    GREYS.iter().flat_map(|&grey| [grey; 3]).collect()
}

fn rgba() -> Vec<u8> {
    GREYS.iter().flat_map(|&grey| [grey, grey, grey, 255]).collect()
}

fn bmp(samples: &[u8], colour: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    BmpEncoder::new(&mut file).write_image(samples, 2, 3, colour).unwrap();
    file
}

fn tiff(samples: &[u8], colour: ExtendedColorType) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    TiffEncoder::new(&mut file).write_image(samples, 2, 3, colour).unwrap();
    file.into_inner()
}

#[test]
fn bmp_and_tiff_of_grey_and_colour_hold_the_same_map() {
    let wide: Vec<u8> =
        GREYS.iter().flat_map(|&grey| (u16::from(grey) * 257).to_ne_bytes()).collect();
    for file in [
        bmp(&GREYS, ExtendedColorType::L8),
        bmp(&rgb(), ExtendedColorType::Rgb8),
        tiff(&GREYS, ExtendedColorType::L8),
        tiff(&wide, ExtendedColorType::L16),
        tiff(&rgb(), ExtendedColorType::Rgb8),
    ] {
        let (map, warnings) = read(&[], &file).unwrap();
        assert_eq!(map.to_ascii(), PICTURE, "{}", file.escape_ascii());
        assert_eq!(warnings, []);
    }
}

#[test]
fn a_bmp_of_32_bit_and_an_opaque_tiff_hold_the_same_map() {
    for file in [bmp(&rgba(), ExtendedColorType::Rgba8), tiff(&rgba(), ExtendedColorType::Rgba8)] {
        assert_eq!(picture(&[], &file), PICTURE);
    }
}

#[test]
fn pixel_maps_count_by_the_mean_of_their_colours() {
    let raw = [&b"P6\n# GIMP\n2 3\n255\n"[..], &rgb()].concat();
    let plain: String = rgb().iter().map(|sample| format!(" {sample}")).collect();
    let plain = format!("P3 2 3 255{plain}");
    let wide: Vec<u8> = rgb().iter().flat_map(|&s| (u16::from(s) * 257).to_be_bytes()).collect();
    let wide = [&b"P6 2 3 65535\n"[..], &wide].concat();
    for file in [raw, plain.into_bytes(), wide] {
        assert_eq!(picture(&[], &file), PICTURE, "{}", file.escape_ascii());
    }
    // Means 255/3 and 510/3: p = 0.67 and 0.33.
    let colours = b"P3 2 1 255 255 0 0 255 0 255";
    assert_eq!(picture(&[("free_thresh", "0.34")], colours), "#.\n");
}

#[test]
fn bit_maps_know_black_and_white() {
    let expected = "#.#.#.#.##\n..........\n";
    for file in [
        &b"P1 10 2\n1010101011\n0000000000\n"[..],
        b"P1\n# plain\n10 2 1 0 1 0 1 0 1 0 1 1 0 0 0 0 0 0 0 0 0 0",
        b"P4\n10 2\n\xaa\xc0\x00\x3f",
    ] {
        assert_eq!(picture(&[], file), expected, "{}", file.escape_ascii());
    }
}

#[test]
fn a_jpeg_is_read_with_a_warning() {
    let blocks: Vec<u8> = (0..16 * 16).map(|at| if at % 16 < 8 { 0 } else { 254 }).collect();
    let mut file = Vec::new();
    let encoder = JpegEncoder::new_with_quality(&mut file, 95);
    encoder.write_image(&blocks, 16, 16, ExtendedColorType::L8).unwrap();
    let (map, warnings) = read(&[], &file).unwrap();
    assert_eq!(map.to_ascii(), "########........\n".repeat(16));
    assert_eq!(warnings, [MapWarning::Lossy]);
    for length in 0..file.len() {
        assert!(read(&[], &file[..length]).is_err(), "{length} of {}", file.len());
    }
}

#[test]
fn every_truncation_is_an_error() {
    for file in [
        [&b"P6\n2 3\n255\n"[..], &rgb()].concat(),
        b"P4\n10 2\n\xaa\xc0\x00\x3f".to_vec(),
        b"P1 3 1 1 0 1".to_vec(),
        b"P3 1 1 9 1 2 3".to_vec(),
        bmp(&GREYS, ExtendedColorType::L8),
        bmp(&rgb(), ExtendedColorType::Rgb8),
        tiff(&GREYS, ExtendedColorType::L8),
    ] {
        assert!(read(&[], &file).is_ok());
        for length in 0..file.len() {
            assert!(read(&[], &file[..length]).is_err(), "{length} of {}", file.escape_ascii());
        }
    }
}

#[test]
fn a_palette_is_resolved() {
    // Two bits a pixel; entry 0 is unknown, 1 occupied, 2 free.
    let palette = [205, 205, 205, 0, 0, 0, 254, 254, 254];
    let mut file = Vec::new();
    let mut info = png::Info::with_size(4, 1);
    info.color_type = png::ColorType::Indexed;
    info.bit_depth = png::BitDepth::Two;
    info.palette = Some(palette[..].into());
    let mut writer = png::Encoder::with_info(&mut file, info).unwrap().write_header().unwrap();
    writer.write_image_data(&[0b01_10_00_01]).unwrap();
    writer.finish().unwrap();
    assert_eq!(picture(&[], &file), "#.?#\n");
}

#[test]
fn a_git_lfs_pointer_is_named_with_its_remedy() {
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n";
    let error = read(&[], pointer).unwrap_err();
    assert_eq!(error, MapImageError::LfsPointer);
    assert!(error.to_string().contains("git lfs pull"), "{error}");
    let error = ogm_io::MapHeader::parse(pointer).unwrap_err();
    assert!(error.to_string().contains("git lfs pull"), "{error}");
}

#[test]
fn a_picture_that_states_more_than_its_bytes_can_hold_is_refused() {
    let mut file = bmp(&GREYS, ExtendedColorType::L8);
    file[18..22].copy_from_slice(&20_000_u32.to_le_bytes());
    file[22..26].copy_from_slice(&20_000_u32.to_le_bytes());
    let error = read(&[], &file).unwrap_err();
    assert!(matches!(error, MapImageError::WrongLength { need: 400_000_000, .. }), "{error}");
}
