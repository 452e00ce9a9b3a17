//! Publishes a map of a given side on /map once a second, to measure the wire. `wire SIDE COUNT`

use std::thread::sleep;
use std::time::{Duration, SystemTime};

use ogm_io::ros::{Header, MapMetaData, OccupancyGridMessage, Time, to_cdr};
use ogm_ros::dds::{Durability, Node};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<u32> =
        std::env::args().skip(1).map(|number| number.parse()).collect::<Result<_, _>>()?;
    let [side, count] = arguments[..] else {
        return Err("write SIDE COUNT".into());
    };
    let node = Node::new(0)?;
    let map = node.publish("/map", OccupancyGridMessage::TYPE, Durability::TransientLocal, 1)?;
    sleep(Duration::from_secs(3));
    for turn in 0..count {
        let cells = u64::from(side) * u64::from(side);
        let value = |cell: u64| u8::try_from((7 * cell + u64::from(turn)) % 101).unwrap_or(0);
        let data = (0..cells).map(value).collect();
        let info =
            MapMetaData { resolution: 0.05, width: side, height: side, ..Default::default() };
        #[expect(clippy::disallowed_methods, reason = "what is measured is time")]
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH)?;
        let stamp = Time::from_nanoseconds(u64::try_from(now.as_nanos())?);
        let header = Header { stamp, frame_id: "world".to_owned() };
        map.send(to_cdr(&OccupancyGridMessage { header, info, data })?);
        sleep(Duration::from_secs(1));
    }
    sleep(Duration::from_secs(30));
    Ok(())
}
