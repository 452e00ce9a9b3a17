//! Tag logs.

use nalgebra::Point2;
use ogm_core::{TagId, TagReading};
use ogm_io::{IoError, TagLogError, parse_tags, read_tags, write_tags};
use proptest::prelude::{ProptestConfig, Strategy, any, prop_assert_eq, proptest};

const HEADER: &str = "tag_id,robot_x_m,robot_y_m,range_m\n";

fn reading() -> impl Strategy<Value = TagReading> {
    (any::<u128>(), -1e6_f64..1e6, -1e6_f64..1e6, 0.0_f64..1e3).prop_map(|(tag_id, x, y, range)| {
        TagReading { tag_id: TagId::from_bits(tag_id), robot_position: Point2::new(x, y), range }
    })
}

fn error(lines: &str) -> TagLogError {
    parse_tags(format!("{HEADER}{lines}").as_bytes()).unwrap_err()
}

proptest! {
    // Each case waits for the disk.
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn readings_survive_bit_for_bit(readings in proptest::collection::vec(reading(), 0..20)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tags.csv");
        std::fs::write(&path, "an older log").unwrap();
        write_tags(&path, &readings).unwrap();
        prop_assert_eq!(read_tags(&path).unwrap(), readings);
        prop_assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn no_bytes_make_the_parser_panic(bytes in proptest::collection::vec(any::<u8>(), 0..80)) {
        let _ = parse_tags(&bytes);
        let _ = parse_tags(&[HEADER.as_bytes(), &bytes].concat());
    }
}

#[test]
fn spreadsheets_and_windows_are_understood() {
    let text = "\u{feff}tag_id, robot_x_m, robot_y_m, range_m\r\n7, -1.5, 2e0, .25\r\n\r\n";
    let expected =
        TagReading { tag_id: 7.into(), robot_position: Point2::new(-1.5, 2.0), range: 0.25 };
    assert_eq!(parse_tags(text.as_bytes()).unwrap(), [expected]);
    assert_eq!(parse_tags(HEADER.as_bytes()).unwrap(), []);
}

#[test]
fn another_header_is_refused() {
    for text in ["", "7,1,2,3\n", "tag_id,robot_x_m,robot_y_m\n", "tag,x,y,range\n"] {
        let error = parse_tags(text.as_bytes()).unwrap_err();
        assert!(matches!(error, TagLogError::Header { .. }), "{error}");
        assert!(error.to_string().contains(HEADER.trim()), "{error}");
    }
}

#[test]
fn a_bad_value_is_named_with_its_line() {
    for (value, column, quoted) in [
        ("x,1,2,3", "tag_id", "x"),
        ("-1,1,2,3", "tag_id", "-1"),
        ("18446744073709551616,1,2,3", "tag_id", "18446744073709551616"),
        ("1,nan,2,3", "robot_x_m", "nan"),
        ("1,1,inf,3", "robot_y_m", "inf"),
        ("1,1,,3", "robot_y_m", ""),
        ("1,1,2,-0.5", "range_m", "-0.5"),
        ("1,1,2,3m", "range_m", "3m"),
    ] {
        let error = error(&format!("5,1,2,3\n{value}\n"));
        let TagLogError::Value { line, column: found, value, .. } = error else {
            panic!("{error}");
        };
        assert_eq!((line, found, value.as_str()), (3, column, quoted));
    }
    for (value, columns) in [("1,2,3", 3), ("1,2,3,4,5", 5), ("1;2;3;4", 1)] {
        let error = error(value);
        assert!(
            matches!(error, TagLogError::Columns { line: 2, found, .. } if found == columns),
            "{error}"
        );
    }
    let not_text = [HEADER.as_bytes(), b"1,2,3,4\n1,\xff,3,4\n"].concat();
    assert_eq!(parse_tags(&not_text), Err(TagLogError::NotText { line: 3 }));
}

#[test]
fn what_could_not_be_read_back_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tags.csv");
    let good = TagReading { tag_id: 1.into(), robot_position: Point2::new(0.0, 0.0), range: 1.0 };
    write_tags(&path, &[good]).unwrap();
    for bad in [
        TagReading { range: -1.0, ..good },
        TagReading { range: f64::NAN, ..good },
        TagReading { robot_position: Point2::new(0.0, f64::INFINITY), ..good },
    ] {
        let error = write_tags(&path, &[good, bad]).unwrap_err();
        assert!(matches!(error, IoError::Tags { .. }) && error.to_string().contains("line 3"));
    }
    assert_eq!(read_tags(&path).unwrap(), [good]);
    assert!(matches!(read_tags(&folder.path().join("no.csv")), Err(IoError::Access { .. })));
}
