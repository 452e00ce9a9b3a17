//! A merged map as a bag, laid out as `ogm-ros` publishes it.

use std::io::Cursor;

use ogm_core::OccupancyGrid;
use ogm_io::ros::{Header, OccupancyGridMessage, TfMessage, TransformStamped, to_cdr};
use ogm_io::{BagTopic, BagWriter, OCCUPANCY_GRID_DEFINITION};
use ogm_merge::Component;

use crate::named::frame_of;

const WORLD: &str = "world";
/// Of all messages: the bytes of a bag are those of its maps, whenever it is written.
const TIME_NS: u64 = 0;

/// The map on `/map` in frame `world`, and where the maps' frames lie there on `/tf_static`.
pub(crate) fn bytes_of(
    map: &OccupancyGrid,
    component: &Component,
    frames: &[String],
) -> anyhow::Result<Vec<u8>> {
    let header = Header { frame_id: WORLD.to_owned(), ..Header::default() };
    let placed = component.members.iter().map(|member| TransformStamped {
        header: header.clone(),
        child_frame_id: frame_of(member.map, frames),
        transform: member.reference_from_map.into(),
    });
    let placed = TfMessage { transforms: placed.collect() };
    let merged = OccupancyGridMessage::from_map(header.clone(), map)?;
    let mut bag = BagWriter::new(Cursor::new(Vec::new()))?;
    let topics = [
        ("/map", OccupancyGridMessage::TYPE, OCCUPANCY_GRID_DEFINITION, to_cdr(&merged)?),
        ("/tf_static", TfMessage::TYPE, TfMessage::DEFINITION, to_cdr(&placed)?),
    ];
    for (name, kind, definition, message) in topics {
        let topic = bag.add(&BagTopic { name, kind, definition })?;
        bag.write(topic, TIME_NS, &message)?;
    }
    let (file, _metadata) = bag.finish("")?;
    Ok(file.into_inner())
}
