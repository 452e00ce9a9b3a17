//! One picture in every image format.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use proptest::prelude::{any, prop_assert, proptest};

use crate::{picture, read};

const PICTURE: &str = "#.\n.?\n?#\n";
const GREYS: [u8; 6] = [0, 254, 254, 205, 205, 0];

pub(crate) fn png(width: u32, height: u32, samples: &[u8], colour: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new(&mut file).write_image(samples, width, height, colour).unwrap();
    file
}

#[test]
fn plain_and_raw_pgm_of_8_and_16_bit_hold_the_same_map() {
    let mut raw = b"P5\n# CREATOR: map_saver\n2 3\n255\n".to_vec();
    raw.extend(GREYS);
    let mut wide = b"P5 2 3 65535\n".to_vec();
    wide.extend(GREYS.iter().flat_map(|&grey| (u16::from(grey) * 257).to_be_bytes()));
    let mut windows = b"P5\r\n2 3\r\n255\r\n".to_vec();
    windows.extend(GREYS);
    let mut trailing = raw.clone();
    trailing.push(b'\n');
    let plain = b"P2#x\n2# columns\n#\n3\t255\n0 254 254\r\n205#\n205 0".to_vec();
    let plain_wide = b"P2 2 3 65535\n0 65278 65278 52685 52685 0\n".to_vec();
    for image in [raw, wide, windows, trailing, plain, plain_wide] {
        assert_eq!(picture(&[], &image), PICTURE, "{}", image.escape_ascii());
    }
}

#[test]
fn a_maximum_below_255_rescales() {
    assert_eq!(picture(&[], b"P2 4 1 100\n0 100 80 20\n"), "#.?#\n");
}

#[test]
fn grey_and_colour_png_hold_the_same_map() {
    assert_eq!(picture(&[], &png(2, 3, &GREYS, ExtendedColorType::L8)), PICTURE);
    let rgb: Vec<u8> = GREYS.iter().flat_map(|&grey| [grey; 3]).collect();
    assert_eq!(picture(&[], &png(2, 3, &rgb, ExtendedColorType::Rgb8)), PICTURE);
    let wide: Vec<u8> =
        GREYS.iter().flat_map(|&grey| (u16::from(grey) * 257).to_ne_bytes()).collect();
    assert_eq!(picture(&[], &png(2, 3, &wide, ExtendedColorType::L16)), PICTURE);
}

#[test]
fn colours_count_by_their_mean() {
    // Means 255/3 and 510/3: p = 0.67 and 0.33.
    let pixels = [255, 0, 0, 255, 0, 255];
    let file = png(2, 1, &pixels, ExtendedColorType::Rgb8);
    assert_eq!(picture(&[("free_thresh", "0.34")], &file), "#.\n");
}

proptest! {
    #[test]
    fn no_bytes_make_the_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(read(&[], &bytes).is_err());
        for magic in [&b"P2 "[..], b"P5\n", b"P5 3 3 255 ", b"P2 2 1 9 ", b"\x89PNG\r\n\x1a\n"] {
            let _ = read(&[], &[magic, &bytes].concat());
        }
    }

    #[test]
    fn a_damaged_png_does_not_panic(at in 8_usize..60, value in any::<u8>()) {
        let mut file = png(2, 3, &GREYS, ExtendedColorType::L8);
        if let Some(byte) = file.get_mut(at) {
            *byte = value;
        }
        let _ = read(&[], &file);
    }
}

#[test]
fn every_truncation_is_an_error() {
    let raw = [&b"P5\n2 3\n255\n"[..], &GREYS].concat();
    let wide = [&b"P5\n1 3\n65535\n"[..], &GREYS].concat();
    let plain = b"P2\n2 3\n255\n0 254 254 205 205 0".to_vec();
    let grey = png(2, 3, &GREYS, ExtendedColorType::L8);
    let alpha = png(1, 3, &GREYS, ExtendedColorType::La8);
    for file in [raw, wide, plain, grey, alpha] {
        assert!(read(&[], &file).is_ok());
        for length in 0..file.len() {
            let cut = &file[..length];
            assert!(read(&[], cut).is_err(), "{} of {}", length, file.len());
        }
    }
}
