//! Files that cannot be meant: a typed error that says where and what to do.

use ogm_core::GridError;
use ogm_io::{IoError, MapHeader, MapImageError, YamlError, read_map};
use proptest::prelude::{any, prop_assert, proptest};

use crate::{read, yaml_with};

fn yaml_error(changes: &[(&str, &str)]) -> YamlError {
    MapHeader::parse(yaml_with(changes).as_bytes()).unwrap_err()
}

#[test]
fn every_required_key_is_asked_for_by_name() {
    for key in ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"] {
        for absent in ["", "~", "null"] {
            let error = yaml_error(&[(key, absent)]);
            assert!(
                matches!(error, YamlError::MissingKey { key: found, .. } if found == key),
                "{error}"
            );
            assert!(error.to_string().contains(&format!("`{key}: ")), "{error}");
        }
    }
    assert!(MapHeader::parse(b"").is_err());
}

#[test]
fn values_out_of_their_domain_are_quoted() {
    for (key, value) in [
        ("resolution", "5 cm"),
        ("origin", "[nan, 0, 0]"),
        ("origin", "[0, -.nan, 0]"),
        ("origin", "[0, .inf, 0]"),
        ("origin", "[0, 0, -inf]"),
        ("origin", "[0, 0, north]"),
        ("origin", "[0, 0]"),
        ("origin", "0"),
        ("resolution", "[0.05, 1]"),
        ("image", "[map.pgm]"),
        ("origin", "[0, 0, 0, 0]"),
        ("occupied_thresh", "65"),
        ("free_thresh", "-0.1"),
        ("free_thresh", ".nan"),
        ("negate", "2"),
        ("negate", "maybe"),
        ("mode", "binary"),
    ] {
        let error = yaml_error(&[(key, value)]);
        assert!(matches!(error, YamlError::Value { key: found, .. } if found == key), "{error}");
        assert!(error.to_string().contains(value), "{error}");
    }
    for (key, value, range) in [
        ("resolution", "0", "0.0001 to 1000 m"),
        ("resolution", "-0.05", "0.0001 to 1000 m"),
        ("resolution", ".nan", "0.0001 to 1000 m"),
        ("resolution", "-nan", "0.0001 to 1000 m"),
        ("resolution", "inf", "0.0001 to 1000 m"),
        ("resolution", "1e300", "0.0001 to 1000 m"),
        ("resolution", "1e-9", "0.0001 to 1000 m"),
        ("origin", "[0, 1e25, 0]", "10000000 m"),
        ("origin", "[-20000000, 0, 0]", "10000000 m"),
    ] {
        let error = yaml_error(&[(key, value)]);
        assert!(matches!(error, YamlError::Frame { key: found, .. } if found == key), "{error}");
        let text = error.to_string();
        assert!(text.contains(&format!("{key}: {value}")) && text.contains(range), "{text}");
    }
    assert!(matches!(yaml_error(&[("image", "''")]), YamlError::Value { .. }));
    for free in ["0.65", "0.7"] {
        let error = yaml_error(&[("free_thresh", free)]);
        assert!(matches!(error, YamlError::Thresholds { .. }), "{error}");
    }
}

#[test]
fn all_the_spellings_of_a_header_are_read() {
    for yaml in [
        yaml_with(&[("resolution", "5e-2"), ("free_thresh", ".196"), ("mode", "trinary")]),
        yaml_with(&[("resolution", "\"0.05\""), ("image", "7")]),
        yaml_with(&[("origin", "\n- -1.0\n- 2\n- 0")]),
        yaml_with(&[("unheard_of", "{a: [1, 2]}")]),
        yaml_with(&[]).replace('\n', "\r\n"),
        yaml_with(&[]).replace(": ", ":\t"),
        format!("%YAML 1.2\n---\n# a map\n{}", yaml_with(&[])),
    ] {
        let (header, warnings) = MapHeader::parse(yaml.as_bytes()).unwrap();
        assert_eq!(header.frame.resolution(), 0.05, "{yaml}");
        assert_eq!(header.frame.map_from_grid().x(), -1.0, "{yaml}");
        assert_eq!(header.free_thresh, 0.196, "{yaml}");
        assert_eq!(warnings, [], "{yaml}");
    }
}

#[test]
fn what_is_no_map_yaml_is_refused_with_a_place() {
    assert_eq!(MapHeader::parse(b"image: \x01"), Err(YamlError::NotText));
    for image in [&b"P5\n\xff\xfe"[..], b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", b"\xff\xd8\xff\xe0"] {
        assert_eq!(MapHeader::parse(image), Err(YamlError::Image));
    }
    let deep = "- ".repeat(20_000);
    let open = "[".repeat(20_000);
    let laughs = "a: &a [x,x,x,x,x,x,x,x,x]\n".to_owned()
        + &('b'..='j')
            .map(|key| {
                let last = char::from_u32(u32::from(key) - 1).unwrap();
                let nine = vec![format!("*{last}"); 9].join(",");
                format!("{key}: &{key} [{nine}]\n")
            })
            .collect::<String>();
    for text in ["[1]", "words", "image: [", &deep, &open, "{a: b} c", "[a]: b", ""] {
        let error = MapHeader::parse(text.as_bytes()).unwrap_err();
        assert!(matches!(error, YamlError::Syntax { .. }), "{error}");
    }
    let error = MapHeader::parse(laughs.as_bytes()).unwrap_err();
    assert!(matches!(error, YamlError::MissingKey { .. }), "aliases are not followed: {error}");
    let text = yaml_with(&[]).replace("negate: 0", "negate: [0");
    let error = MapHeader::parse(text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("`negate` on line 4"), "{error}");
}

#[test]
fn absurd_sizes_are_refused_before_they_are_allocated() {
    let too_large = |image: &[u8]| {
        matches!(read(&[], image), Err(MapImageError::Size(GridError::TooLarge { .. })))
    };
    assert!(too_large(b"P5 1000000000 1000000000 255\nabc"));
    assert!(too_large(b"P2 1000000000 1000000000 255\n1 2 3"));
    assert!(too_large(&png_header(1_000_000_000, 1_000_000_000)));
    let short = |image: &[u8]| {
        matches!(read(&[], image), Err(MapImageError::WrongLength { need: 400_000_000, .. }))
    };
    assert!(short(b"P5 20000 20000 255\nabc"));
    assert!(short(b"P2 20000 20000 255\n1 2 3"));
    assert!(short(&png_header(20_000, 20_000)));
}

#[test]
fn images_that_cannot_be_meant_are_refused() {
    let error = |image: &[u8]| read(&[], image).unwrap_err();
    for other in [&b""[..], b"P", b"P5", b"P7 1 1 ", b"P0 1 1", b"BM....", b"P55 1 1"] {
        assert!(matches!(error(other), MapImageError::Format { .. }), "{}", error(other));
    }
    for (image, field) in [
        (&b"P5 0 3 255\n"[..], "width"),
        (b"P5 3 -3 255\n", "height"),
        (b"P2 3 3.5 255 1", "height"),
        (b"P5 1 1 0\nx", "maximum"),
        (b"P5 1 1 65536\nxx", "maximum"),
        (b"P5 99999999999999999999999 1 255\nx", "width"),
        (b"P5 1", "height"),
    ] {
        let error = error(image);
        assert!(error.to_string().starts_with(field), "{error}");
    }
    for (image, found) in [
        (&b"P5 2 2 255\nabc"[..], 3),
        (b"P5 2 2 255\nabcde", 5),
        (b"P5 2 1 256\nabc", 1),
        (b"P2 2 2 255\n1 2 3", 3),
        (b"P2 2 2 255\n1 2 3 4 5", 5),
    ] {
        let error = error(image);
        assert!(
            matches!(error, MapImageError::WrongLength { found: counted, .. } if counted == found),
            "{error}"
        );
    }
    for image in [&b"P2 2 1 100\n1 101"[..], b"P2 2 1 100\n1 x", b"P5 2 1 100\n\x01\x65"] {
        let error = error(image);
        assert!(matches!(error, MapImageError::Pixel { index: 1, .. }), "{error}");
    }
}

#[test]
fn an_error_names_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let yaml = folder.path().join("lab.yaml");
    let text = |error: IoError| error.to_string();
    let error = read_map(&yaml).unwrap_err();
    assert!(matches!(error, IoError::Access { .. }) && text(error).contains("lab.yaml"));
    let error = read_map(folder.path()).unwrap_err();
    assert!(text(error).contains("regular file"));

    std::fs::write(&yaml, yaml_with(&[])).unwrap();
    let error = text(read_map(&yaml).unwrap_err());
    assert!(error.contains("map.pgm") && error.contains("lab.yaml"), "{error}");

    std::fs::write(folder.path().join("map.pgm"), b"P5 2 2 255\nabc").unwrap();
    let error = text(read_map(&yaml).unwrap_err());
    assert!(error.contains("map.pgm") && error.contains("2 × 2"), "{error}");

    std::fs::write(&yaml, yaml_with(&[("resolution", "zero")])).unwrap();
    let error = text(read_map(&yaml).unwrap_err());
    assert!(error.contains("lab.yaml") && error.contains("resolution: zero"), "{error}");

    std::fs::write(&yaml, vec![b' '; 100_000]).unwrap();
    let error = text(read_map(&yaml).unwrap_err());
    assert!(error.contains("larger than"), "{error}");
}

#[test]
fn an_image_elsewhere_is_found_by_an_absolute_path() {
    let [here, there] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let image = there.path().join("a.pgm");
    std::fs::write(&image, b"P2 1 1 255 0").unwrap();
    let yaml = here.path().join("lab.yaml");
    std::fs::write(&yaml, yaml_with(&[("image", image.to_str().unwrap())])).unwrap();
    let loaded = read_map(&yaml).unwrap();
    assert_eq!((loaded.image, loaded.map.to_ascii().as_str()), (image, "#\n"));
}

proptest! {
    #[test]
    fn no_yaml_makes_the_parser_panic(bytes in proptest::collection::vec(any::<u8>(), 0..120)) {
        prop_assert!(MapHeader::parse(&bytes).is_err());
    }

    #[test]
    fn no_value_makes_the_parser_panic(key in 0_usize..7, value in "[ -~]{0,12}") {
        let keys = ["image", "resolution", "origin", "negate", "occupied_thresh", "mode", "x"];
        if let Ok((header, _)) = MapHeader::parse(yaml_with(&[(keys[key], &value)]).as_bytes()) {
            prop_assert!(header.frame.resolution() > 0.0);
            prop_assert!(header.frame.map_from_grid().is_finite());
            prop_assert!(0.0 <= header.free_thresh && header.free_thresh < header.occupied_thresh);
        }
    }
}

/// A PNG of 8-bit grey that states a size and holds next to nothing.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut ihdr = [width.to_be_bytes(), height.to_be_bytes()].concat();
    ihdr.extend([8, 0, 0, 0, 0]);
    let chunks = [chunk(b"IHDR", &ihdr), chunk(b"IDAT", &[0x78, 0x9c, 3, 0]), chunk(b"IEND", &[])];
    [b"\x89PNG\r\n\x1a\n".to_vec(), chunks.concat()].concat()
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [&kind[..], data].concat();
    let length = u32::try_from(data.len()).unwrap().to_be_bytes();
    [&length[..], &body, &checksum(&body).to_be_bytes()].concat()
}

/// The CRC-32 of PNG.
pub(crate) fn checksum(body: &[u8]) -> u32 {
    !body.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 }
        })
    })
}
