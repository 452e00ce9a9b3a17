//! Writes MCAP that `ros2 bag`, Foxglove and rosbags read.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{Seek, Write};

use mcap::records::MessageHeader;
use mcap::{WriteOptions, Writer};

use super::error::BagError;

/// What `ros2 bag` notes of a topic that is reliable, latched and keeps one message, every field of
/// it: a reader that misses one gives no messages at all.
const LATCHED_QOS: &str = "\
- history: 1
  depth: 1
  reliability: 1
  durability: 1
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: 1
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false";

/// A topic of a bag that is written; reliable and latched, as maps are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BagTopic<'a> {
    /// The topic, such as `/map`.
    pub name: &'a str,
    /// Its type, such as `nav_msgs/msg/OccupancyGrid`.
    pub kind: &'a str,
    /// The definition of the type, with those that it is made of.
    pub definition: &'a str,
}

/// A topic that was added to a bag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TopicId(usize);

/// A topic, and what was written on it.
struct Written {
    name: String,
    kind: String,
    channel: u16,
    messages: u32,
}

/// An MCAP bag in the making.
pub struct BagWriter<W: Write + Seek> {
    writer: Writer<W>,
    topics: Vec<Written>,
    /// Times of the first and the last message.
    span_ns: Option<(u64, u64)>,
}

impl<W: Write + Seek> BagWriter<W> {
    /// A bag into `file`, compressed by zstd.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn new(file: W) -> Result<Self, BagError> {
        let writer = WriteOptions::new().profile("ros2").create(file).map_err(failed)?;
        Ok(Self { writer, topics: Vec::new(), span_ns: None })
    }

    /// Adds a topic.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn add(&mut self, topic: &BagTopic<'_>) -> Result<TopicId, BagError> {
        let BagTopic { name, kind, definition } = *topic;
        let schema =
            self.writer.add_schema(kind, "ros2msg", definition.as_bytes()).map_err(failed)?;
        let qos = ("offered_qos_profiles".to_owned(), LATCHED_QOS.to_owned());
        let metadata = BTreeMap::from([qos]);
        let channel = self.writer.add_channel(schema, name, "cdr", &metadata).map_err(failed)?;
        let (name, kind) = (name.to_owned(), kind.to_owned());
        self.topics.push(Written { name, kind, channel, messages: 0 });
        Ok(TopicId(self.topics.len() - 1))
    }

    /// Adds a message, header included.
    ///
    /// # Errors
    /// A file that cannot be written, a topic of another bag.
    pub fn write(&mut self, topic: TopicId, time_ns: u64, message: &[u8]) -> Result<(), BagError> {
        let foreign = || BagError::Write { message: "a topic of another bag".to_owned() };
        let topic = self.topics.get_mut(topic.0).ok_or_else(foreign)?;
        let header = MessageHeader {
            channel_id: topic.channel,
            sequence: topic.messages,
            log_time: time_ns,
            publish_time: time_ns,
        };
        self.writer.write_to_known_channel(&header, message).map_err(failed)?;
        topic.messages = topic.messages.wrapping_add(1);
        let (first, last) = self.span_ns.unwrap_or((time_ns, time_ns));
        self.span_ns = Some((first.min(time_ns), last.max(time_ns)));
        Ok(())
    }

    /// Ends the bag. Gives the file, and the `metadata.yaml` that makes a bag of the folder in which
    /// the file is called `file_name`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(mut self, file_name: &str) -> Result<(W, String), BagError> {
        self.writer.finish().map_err(failed)?;
        let metadata = self.metadata(file_name);
        Ok((self.writer.into_inner(), metadata))
    }

    fn metadata(&self, file_name: &str) -> String {
        let (first, last) = self.span_ns.unwrap_or((0, 0));
        let count: u64 = self.topics.iter().map(|topic| u64::from(topic.messages)).sum();
        let span = |indent: &str| {
            format!(
                "{indent}duration:\n{indent}  nanoseconds: {}\n{indent}starting_time:\n\
                 {indent}  nanoseconds_since_epoch: {first}\n{indent}message_count: {count}\n",
                last - first
            )
        };
        let mut text = format!(
            "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n{}",
            span("  ")
        );
        text += "  topics_with_message_count:\n";
        for Written { name, kind, messages, .. } in &self.topics {
            let qos = LATCHED_QOS.replace('\n', "\\n");
            text += &format!(
                "    - topic_metadata:\n        name: {name}\n        type: {kind}\n        \
                 serialization_format: cdr\n        offered_qos_profiles: \"{qos}\"\n      \
                 message_count: {messages}\n"
            );
        }
        text += &format!(
            "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - \
             {file_name}\n  files:\n    - path: {file_name}\n{}",
            span("      ")
        );
        text
    }
}

impl<W: Write + Seek> fmt::Debug for BagWriter<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BagWriter").field("span_ns", &self.span_ns).finish_non_exhaustive()
    }
}

fn failed(error: mcap::McapError) -> BagError {
    BagError::Write { message: error.to_string() }
}
