//! The defects of real map files.

use ogm_io::{MapWarning, ReadOptions};

use crate::{header_with, picture, read};

const SAVED: &[u8] = b"P2 4 1 255 0 205 254 205";

#[test]
fn grey_205_is_unknown_below_an_old_free_threshold() {
    let keys = [("free_thresh", "0.25")];
    let (map, warnings) = read(&keys, SAVED).unwrap();
    assert_eq!(map.to_ascii(), "#?.?\n");
    let expected = MapWarning::GreyReadAsUnknown { free_thresh: 0.25, cells: 2 };
    assert_eq!(warnings, [expected]);

    let literal = ReadOptions { literal_205: true, ..ReadOptions::default() };
    let (map, warnings) = header_with(&keys).0.read_image(SAVED.to_vec(), &literal).unwrap();
    assert_eq!(map.to_ascii(), "#...\n");
    let expected = MapWarning::GreyReadAsFree { free_thresh: 0.25, cells: 2 };
    assert_eq!(warnings, [expected]);
}

#[test]
fn grey_205_is_rescued_only_where_it_must_be() {
    for (free_thresh, image, expected) in [
        ("0.196", SAVED, "#?.?\n"),
        // 50/255 exactly: strictly below it there is nothing to rescue.
        ("0.19607843137254902", SAVED, "#?.?\n"),
        // A fourth level: not what a map_saver writes, so the file means what it says.
        ("0.25", b"P2 4 1 255 0 205 254 230", "#...\n"),
        ("0.25", b"P2 4 1 254 0 205 254 205", "#...\n"),
    ] {
        let (map, warnings) = read(&[("free_thresh", free_thresh)], image).unwrap();
        assert_eq!(map.to_ascii(), expected, "{free_thresh}");
        assert_eq!(warnings, [], "{free_thresh}");
    }
    // A map without walls is still a saver's map.
    assert_eq!(picture(&[("free_thresh", "0.25")], b"P2 2 1 255 205 254"), "?.\n");
    let negated = [("free_thresh", "0.25"), ("negate", "1")];
    assert_eq!(picture(&negated, SAVED), ".###\n");
}

#[test]
fn an_origin_of_three_digits_is_suspicious() {
    let warnings = |origin| header_with(&[("origin", origin)]).1;
    let rounded =
        |axis, text: &str, error| MapWarning::RoundedOrigin { axis, text: text.to_owned(), error };
    assert_eq!(warnings("[1.23e+04, -4.5, 0]"), [rounded('x', "1.23e+04", 50.0)]);
    assert_eq!(
        warnings("[1e+03, -152, 0]"),
        [rounded('x', "1e+03", 5.0), rounded('y', "-152", 0.5)]
    );
    for plain in ["[12345.123, 0.0, 0]", "[-100.000000, -51.2, 0]", "[99, 0.00123, 0]"] {
        assert_eq!(warnings(plain), [], "{plain}");
    }
}

#[test]
fn a_yaw_that_is_not_a_number_is_zero() {
    for yaw in ["-nan", "nan", ".nan", "-.NaN", "NaN", "\"nan\"", "-nan(ind)"] {
        let origin = format!("[1.0, 2.0, {yaw}]");
        let (header, warnings) = header_with(&[("origin", &origin)]);
        assert_eq!(header.frame.map_from_grid().theta(), 0.0, "{yaw}");
        assert_eq!(header.frame.map_from_grid().x(), 1.0, "{yaw}");
        assert_eq!(warnings, [MapWarning::YawNotANumber], "{yaw}");
    }
}

#[test]
fn probabilities_in_a_trinary_file_are_noticed() {
    let levels: String = (0..40).map(|level| format!(" {}", level * 6)).collect();
    let image = format!("P2 40 1 255{levels}");
    let (_, warnings) = read(&[], image.as_bytes()).unwrap();
    assert_eq!(warnings, [MapWarning::GreyLevels { levels: 40 }]);
    let (_, warnings) = read(&[("mode", "scale")], image.as_bytes()).unwrap();
    assert_eq!(warnings, []);
}

#[test]
fn warnings_say_what_was_made_of_it() {
    let (_, warnings) = read(&[("free_thresh", "0.25")], SAVED).unwrap();
    let text = warnings[0].to_string();
    for part in ["2 cells", "205", "unknown", "0.25", "0.196"] {
        assert!(text.contains(part), "{text}");
    }
}
