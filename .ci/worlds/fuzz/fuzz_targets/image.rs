//! Map images, after a byte that says how they are read.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::{MapHeader, MapSize, ReadOptions};
use std::cell::RefCell;
use std::path::PathBuf;
use tempfile::TempDir;

thread_local! {
    static FOLDER: RefCell<TempDir> = RefCell::new(tempfile::tempdir().expect("a temporary folder"));
}

fuzz_target!(|bytes: &[u8]| {
    let Some((&how, image)) = bytes.split_first() else { return };
    let mode = ["trinary", "scale", "raw"][usize::from(how & 3) % 3];
    let yaml = format!(
        "image: a\nmode: {mode}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: {}\n\
         occupied_thresh: 0.65\nfree_thresh: 0.25\n",
        how >> 2 & 1
    );
    let (header, _) = MapHeader::parse(yaml.as_bytes()).expect("a good header");
    let options = ReadOptions { averaged_alpha: how >> 3 & 1 == 1, literal_205: how >> 4 & 1 == 1 };
    let stated = (how >> 5 == 7).then(|| {
        let path: PathBuf = FOLDER.with_borrow(|folder| folder.path().join("image"));
        std::fs::write(&path, image).expect("a file");
        MapSize::of_image(&path)
    });
    let read = header.read_image(image.to_vec(), &options);
    if let Ok((map, _)) = read {
        assert_eq!(map.cells().cells().len(), map.width() * map.height());
        if let Some(Ok(size)) = stated {
            assert_eq!((size.width, size.height), (map.width(), map.height()));
        }
    }
});
