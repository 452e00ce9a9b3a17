//! Tag readings: what is read can be written, and is read again.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::{parse_tags, read_tags, write_tags};

fuzz_target!(|bytes: &[u8]| {
    let Ok(readings) = parse_tags(bytes) else { return };
    assert!(readings.iter().all(|reading| reading.range.is_finite() && reading.range >= 0.0));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("tags.csv");
    write_tags(&path, &readings).expect("what was read can be written");
    assert_eq!(read_tags(&path).expect("what was written can be read"), readings);
});
