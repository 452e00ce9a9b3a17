//! Map YAML: what is read can be meant.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::MapHeader;

fuzz_target!(|bytes: &[u8]| {
    if let Ok((header, _)) = MapHeader::parse(bytes) {
        assert!(header.frame.map_from_grid().is_finite());
        assert!(header.frame.resolution() > 0.0);
        assert!(header.free_thresh < header.occupied_thresh);
    }
});
