//! Reads MCAP, a piece at a time.

use std::fs::File;
use std::io::{self, Read, Seek};
use std::ops::ControlFlow;
use std::path::Path;

use mcap::McapError;
use mcap::read::{ChannelAccumulator, parse_record};
use mcap::records::{Record, op};
use mcap::sans_io::linear_reader::LinearReaderOptions;
use mcap::sans_io::{LinearReadEvent, LinearReader};
use ogm_core::MAX_CELLS;

use super::chunks::overlong_record;
use super::error::BagError;
use super::message::BagMessage;

/// Longest record that is read, bytes: the largest map as a message.
const MOST_RECORD_BYTES: usize = MAX_CELLS + (1 << 20);
/// Most bytes that room is made for at a time: the length of a record is only what its file says.
const MOST_READ_BYTES: usize = 1 << 20;

pub(super) fn read(
    file: &Path,
    wanted: &dyn Fn(&str, &str) -> bool,
    take: &mut dyn FnMut(BagMessage) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, BagError> {
    let damaged = |message: String| BagError::Damaged { format: "MCAP", message };
    let unreadable = |cause: io::Error| damaged(cause.to_string());
    let unparsed = |cause: McapError| damaged(cause.to_string());
    let mut file = File::open(file).map_err(unreadable)?;
    if let Some(place) = overlong_record(&file).map_err(unreadable)? {
        return Err(damaged(format!("the record at byte {place} is longer than its chunk")));
    }
    file.rewind().map_err(unreadable)?;
    let options = LinearReaderOptions::default().with_record_length_limit(MOST_RECORD_BYTES);
    let mut reader = LinearReader::new_with_options(options);
    let mut channels = ChannelAccumulator::default();
    let mut has_ended = false;
    while let Some(event) = reader.next_event() {
        let (kind, data) = match event.map_err(unparsed)? {
            LinearReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need.min(MOST_READ_BYTES)));
                reader.notify_read(read.map_err(unreadable)?);
                continue;
            }
            LinearReadEvent::Record { opcode, data } => (opcode, data),
        };
        // The parser takes it for granted that others, as attachments, are as long as they must be;
        // the summary at the end repeats schemas and channels.
        match kind {
            op::MESSAGE => {}
            op::SCHEMA | op::CHANNEL if !has_ended => {}
            op::DATA_END => {
                has_ended = true;
                continue;
            }
            _ => continue,
        }
        let (header, data) = match parse_record(kind, data).map_err(unparsed)? {
            Record::Schema { header, data } => {
                channels.add_schema_from_slice(header, &data).map_err(unparsed)?;
                continue;
            }
            Record::Channel(channel) => {
                channels.add_channel(channel).map_err(unparsed)?;
                continue;
            }
            Record::Message { header, data } => (header, data),
            _ => continue,
        };
        let channel = channels.get(header.channel_id);
        let unknown = || damaged(format!("a message on channel {}, unheard of", header.channel_id));
        let channel = channel.ok_or_else(unknown)?;
        let topic = &channel.topic;
        let kind = channel.schema.as_ref().map_or("", |schema| &schema.name);
        if !wanted(topic, kind) {
            continue;
        }
        let encoding = &channel.message_encoding;
        if encoding != "cdr" {
            let (topic, encoding) = (topic.clone(), encoding.clone());
            return Err(BagError::Encoding { topic, encoding });
        }
        let message = BagMessage {
            topic: topic.clone(),
            kind: kind.to_owned(),
            log_time_ns: header.log_time,
            data: data.into_owned(),
        };
        if take(message).is_break() {
            return Ok(ControlFlow::Break(()));
        }
    }
    Ok(ControlFlow::Continue(()))
}
