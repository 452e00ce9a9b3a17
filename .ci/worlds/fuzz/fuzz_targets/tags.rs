//! Tag readings: what is read can be written, and is read again.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::{parse_tags, write_tags};

fuzz_target!(|bytes: &[u8]| {
    let Ok(readings) = parse_tags(bytes) else { return };
    assert!(readings.iter().all(|reading| reading.range.is_finite() && reading.range >= 0.0));
    let text = write_tags(&readings).expect("what was read can be written");
    assert_eq!(parse_tags(text.as_bytes()).expect("what was written can be read"), readings);
});
