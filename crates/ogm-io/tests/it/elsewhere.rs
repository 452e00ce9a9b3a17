//! Map files that were edited, moved or saved by other programs.

use std::fs;
use std::path::Path;

use ogm_core::{GridFrame, Se2};
use ogm_io::{
    IoError, MapFiles, MapHeader, MapMode, MapWarning, ReadOptions, TextEncoding, read_map,
};

use crate::{header_with, read, yaml_with};

const IMAGE: &[u8] = b"P2 2 1 255 0 254";

fn saved(folder: &Path, yaml: &[u8], image: &str) -> std::path::PathBuf {
    let path = folder.join("lab.yaml");
    fs::write(&path, yaml).unwrap();
    fs::write(folder.join(image), IMAGE).unwrap();
    path
}

#[test]
fn an_image_that_is_not_where_the_yaml_says_is_read_beside_it() {
    for named in [
        "/opt/robot/maps/map.pgm",
        "maps/map.pgm",
        "../elsewhere/map.pgm",
        "~/no/such/folder/map.pgm",
        r"C:\maps\map.pgm",
    ] {
        let folder = tempfile::tempdir().unwrap();
        let text = yaml_with(&[("image", &format!("'{named}'"))]);
        let yaml = saved(folder.path(), text.as_bytes(), "map.pgm");
        let loaded = read_map(&yaml).unwrap();
        assert_eq!(loaded.map.to_ascii(), "#.\n", "{named}");
        assert_eq!(loaded.image, folder.path().join("map.pgm"));
        let [warning] = &loaded.warnings[..] else { panic!("{:?}", loaded.warnings) };
        let text = warning.to_string();
        assert!(text.contains(named) && text.contains("write image: map.pgm"), "{text}");
    }
}

#[test]
fn where_no_image_is_found_the_places_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let text = yaml_with(&[("image", "/opt/robot/maps/m.pgm")]);
    let yaml = saved(folder.path(), text.as_bytes(), "other.pgm");
    let error = read_map(&yaml).unwrap_err();
    assert!(matches!(error, IoError::MissingImage { .. }));
    let (error, beside) = (error.to_string(), folder.path().join("m.pgm"));
    for part in ["/opt/robot/maps/m.pgm", "key `image`", "lab.yaml", beside.to_str().unwrap()] {
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn of_a_key_that_stands_twice_the_last_value_counts() {
    let text = yaml_with(&[]) + "resolution: 0.1\n";
    let (header, warnings) = MapHeader::parse(text.as_bytes()).unwrap();
    assert_eq!(header.frame.resolution(), 0.1);
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    let text = warning.to_string();
    assert!(
        text.contains("`resolution`") && text.contains("0.05") && text.contains("0.1"),
        "{text}"
    );
}

#[test]
fn a_mode_that_is_no_word_is_trinary() {
    for value in ["[0,0,10]", "{a: 1}", "[[1]]"] {
        let (header, warnings) = header_with(&[("mode", value)]);
        assert_eq!(header.mode, MapMode::Trinary);
        let [warning] = &warnings[..] else { panic!("{warnings:?}") };
        assert!(matches!(warning, MapWarning::ModeNotAWord { .. }));
        assert!(warning.to_string().contains("mode: "), "{warning}");
    }
    let (header, warnings) = header_with(&[("mode", "~")]);
    assert_eq!((header.mode, warnings), (MapMode::Trinary, vec![]));
}

#[test]
fn other_encodings_than_utf_8_are_read_with_a_warning() {
    let text = yaml_with(&[]) + "# Büro\n";
    let units = || text.encode_utf16();
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    let latin1: Vec<u8> = text.chars().map(|c| u8::try_from(c).unwrap()).collect();
    for (bytes, encoding) in [
        ([&b"\xef\xbb\xbf"[..], text.as_bytes()].concat(), TextEncoding::MarkedUtf8),
        ([&b"\xff\xfe"[..], &little].concat(), TextEncoding::Utf16),
        ([&b"\xfe\xff"[..], &big].concat(), TextEncoding::Utf16),
        (little, TextEncoding::Utf16),
        (big, TextEncoding::Utf16),
        (latin1, TextEncoding::Latin1),
    ] {
        let (header, warnings) = MapHeader::parse(&bytes).unwrap();
        assert_eq!(header, header_with(&[]).0, "{encoding:?}");
        assert_eq!(warnings, [MapWarning::Encoding { encoding }]);
    }
}

#[test]
#[cfg(unix)]
fn a_latin_1_file_name_is_found_as_bytes_and_as_text() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let text = yaml_with(&[("image", "b\u{fc}ro.pgm")]);
    let yaml: Vec<u8> = text.chars().map(|c| u8::try_from(c).unwrap()).collect();
    for name in [OsStr::from_bytes(b"b\xfcro.pgm"), OsStr::new("b\u{fc}ro.pgm")] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lab.yaml");
        fs::write(&path, &yaml).unwrap();
        fs::write(folder.path().join(name), IMAGE).unwrap();
        assert_eq!(read_map(&path).unwrap().map.to_ascii(), "#.\n", "{name:?}");
    }
}

#[test]
fn a_picture_without_a_yaml_is_read_with_the_usual_thresholds() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("plan.pgm");
    fs::write(&image, b"P2 3 1 255 0 205 254").unwrap();
    let frame = GridFrame::new(0.1, Se2::new(1.0, 2.0, 0.5)).unwrap();
    let loaded =
        MapFiles::read_picture(&image, frame).unwrap().decode(&ReadOptions::default()).unwrap();
    assert_eq!((loaded.map.to_ascii().as_str(), *loaded.map.frame()), ("#?.\n", frame));
    assert!(matches!(loaded.warnings[..], [MapWarning::NoYaml { .. }]));
}

#[test]
fn one_painted_pixel_does_not_free_what_was_saved_as_unknown() {
    let keys = [("free_thresh", "0.25")];
    let saved = |painted: &str| {
        let mut image = "P2 60 1 255 0 254".to_owned();
        image.push_str(&" 205".repeat(57));
        format!("{image} {painted}").into_bytes()
    };
    for painted in ["205", "255", "254", "0", "120", "230"] {
        let (map, warnings) = read(&keys, &saved(painted)).unwrap();
        assert!(map.to_ascii().starts_with(&format!("#.{}", "?".repeat(57))), "{painted}");
        assert!(matches!(warnings[..], [MapWarning::GreyReadAsUnknown { .. }]), "{painted}");
    }
    let wide: String = (0..60).map(|at| if at < 2 { " 65278" } else { " 52685" }).collect();
    let (map, _) = read(&keys, format!("P2 60 1 65535{wide}").as_bytes()).unwrap();
    assert!(map.to_ascii().starts_with("..????"), "16 bit says the same");
}

#[test]
#[cfg(unix)]
fn what_is_no_file_is_not_opened() {
    use std::os::unix::net::UnixListener;
    let folder = tempfile::tempdir().unwrap();
    let socket = folder.path().join("socket.yaml");
    let _listener = UnixListener::bind(&socket).unwrap();
    for (path, kind) in [(socket.as_path(), "a socket"), (Path::new("/dev/zero"), "a device")] {
        let error = read_map(path).unwrap_err().to_string();
        assert!(error.contains(kind) && error.contains("regular file"), "{error}");
    }
}
