//! Maps as messages of ROS 2.

#![no_main]

use libfuzzer_sys::fuzz_target;
use ogm_io::ros::{OccupancyGridMessage, from_cdr, to_cdr};

fuzz_target!(|bytes: &[u8]| {
    let Ok(message) = from_cdr::<OccupancyGridMessage>(bytes) else { return };
    let again = to_cdr(&message).expect("what was read can be written");
    let _ = from_cdr::<OccupancyGridMessage>(&again).expect("what was written can be read");
    if let Ok(map) = message.to_map() {
        assert!(map.frame().map_from_grid().is_finite());
        assert_eq!(map.cells().cells().len(), map.width() * map.height());
    }
});
