//! Reads MCAP, a piece at a time.

use std::fs::File;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::Path;

use mcap::sans_io::linear_reader::LinearReaderOptions;
use mcap::sans_io::{MessageReadEvent, MessageReader};

use super::error::BagError;
use super::message::BagMessage;

/// Longest record that is read, bytes; a chunk holds at least one message.
const MOST_RECORD_BYTES: usize = 1 << 30;

pub(super) fn read(
    file: &Path,
    wanted: &dyn Fn(&str, &str) -> bool,
    take: &mut dyn FnMut(BagMessage) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, BagError> {
    let damaged = |message: String| BagError::Damaged { format: "MCAP", message };
    let mut file = File::open(file).map_err(|cause| damaged(cause.to_string()))?;
    let options = LinearReaderOptions::default().with_record_length_limit(MOST_RECORD_BYTES);
    let mut reader = MessageReader::new_with_options(options);
    while let Some(event) = reader.next_event() {
        match event.map_err(|error| damaged(error.to_string()))? {
            MessageReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need));
                reader.notify_read(read.map_err(|cause| damaged(cause.to_string()))?);
            }
            MessageReadEvent::Message(message) => {
                let topic = &message.channel.topic;
                let kind = message.channel.schema.as_ref().map_or("", |schema| &schema.name);
                if !wanted(topic, kind) {
                    continue;
                }
                let encoding = &message.channel.message_encoding;
                if encoding != "cdr" {
                    let (topic, encoding) = (topic.clone(), encoding.clone());
                    return Err(BagError::Encoding { topic, encoding });
                }
                let message = BagMessage {
                    topic: topic.clone(),
                    kind: kind.to_owned(),
                    log_time_ns: message.log_time,
                    data: message.data.into_owned(),
                };
                if take(message).is_break() {
                    return Ok(ControlFlow::Break(()));
                }
            }
        }
    }
    Ok(ControlFlow::Continue(()))
}
