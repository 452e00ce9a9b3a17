//! The map of a bag that somebody named.

use std::ops::ControlFlow;

use super::error::BagError;
use super::read_bag;
use super::reference::BagMap;
use crate::IoError;
use crate::ros::OccupancyGridMessage;

/// The bytes of the message that holds the map.
pub(crate) fn read_message(map: &BagMap) -> Result<Vec<u8>, IoError> {
    let mut start_ns = u64::MAX;
    let (mut first_ns, mut found) = (None, None);
    let mut have: Vec<String> = Vec::new();
    let limit_ns = map.at_s.map(nanoseconds);
    let is_map = |_: &str, kind: &str| kind == OccupancyGridMessage::TYPE;
    // Without a time, other messages need not be looked at.
    let wanted = |topic: &str, kind: &str| limit_ns.is_some() || is_map(topic, kind);
    read_bag(&map.bag, &wanted, &mut |message| {
        start_ns = start_ns.min(message.log_time_ns);
        if !is_map(&message.topic, &message.kind) {
            return ControlFlow::Continue(());
        }
        if message.topic == map.topic {
            first_ns.get_or_insert(message.log_time_ns);
            let after_ns = message.log_time_ns.saturating_sub(start_ns);
            if limit_ns.is_none_or(|limit| after_ns <= limit) {
                found = Some(message.data);
            }
        } else if !have.contains(&message.topic) {
            have.push(message.topic);
        }
        ControlFlow::Continue(())
    })?;
    found.ok_or_else(|| {
        let topic = map.topic.clone();
        have.sort();
        let cause = match (map.at_s, first_ns) {
            (Some(asked_s), Some(first)) => {
                let first_s = first.saturating_sub(start_ns) as f64 / 1e9;
                BagError::TooEarly { topic, asked_s, first_s }
            }
            _ => BagError::NoMap { topic, have },
        };
        IoError::Bag { path: map.bag.clone(), cause }
    })
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
fn nanoseconds(seconds: f64) -> u64 {
    (seconds * 1e9) as u64
}
