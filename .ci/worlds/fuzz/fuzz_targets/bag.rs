//! Bags, MCAP and SQLite, out of which a map is taken.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::{MapFiles, read_map};
use std::cell::RefCell;
use tempfile::TempDir;

thread_local! {
    static FOLDER: RefCell<TempDir> = RefCell::new(tempfile::tempdir().expect("a temporary folder"));
}

fuzz_target!(|bytes: &[u8]| {
    let bag = FOLDER.with_borrow(|folder| folder.path().join("bag"));
    std::fs::write(&bag, bytes).expect("a file");
    let map = format!("{}:/robot1/map@1.5", bag.display());
    let size = MapFiles::size(map.as_ref());
    if let (Ok(read), Ok((size, _))) = (read_map(map.as_ref()), size) {
        assert_eq!((size.width, size.height), (read.map.width(), read.map.height()));
    }
});
