//! Names of the files that are beside a map only while it is written.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The most bytes of a file name on the file systems of today.
const MOST_BYTES: usize = 255;

/// `.NAME.SUFFIX` beside `target`; a name that would be too long is told by a number instead.
pub(crate) fn beside(target: &Path, name: &OsStr, suffix: &str) -> PathBuf {
    let mut hidden = OsString::from(".");
    if name.len() + suffix.len() + 2 <= MOST_BYTES {
        hidden.push(name);
    } else {
        hidden.push(format!("{:016x}", fnv_1a(name.as_encoded_bytes())));
    }
    hidden.push(".");
    hidden.push(suffix);
    target.with_file_name(hidden)
}

/// The 64-bit hash of Fowler, Noll and Vo: the same in every run and on every machine.
fn fnv_1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
