//! A participant of the network: what others publish, and topics to read and to write.

use std::fmt;

use rustdds::no_key::DataReader;
use rustdds::{DomainParticipant, Publisher, QosPolicies, Subscriber, Topic, TopicKind};

use super::error::DdsError;
use super::names::{dds_topic, dds_type, ros_topic, ros_type};
use super::publication::Publication;
use super::qos::{Durability, offered, requested};
use super::raw::{AsIs, Raw};

/// A participant of one DDS domain.
pub struct Node {
    participant: DomainParticipant,
    publisher: Publisher,
    subscriber: Subscriber,
}

/// Who publishes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Writer {
    /// The topic, such as `/robot1/map`.
    pub topic: String,
    /// The type, such as `nav_msgs/msg/OccupancyGrid`.
    pub kind: String,
    /// Whether who comes late gets the last message.
    pub is_latched: bool,
    /// Whether it repeats what gets lost.
    pub is_reliable: bool,
    /// Tells writers apart: a program that starts again is another one.
    pub identity: [u8; 16],
}

impl Node {
    /// Joins the domain `domain`, `ROS_DOMAIN_ID` to ROS 2.
    ///
    /// # Errors
    /// No network interface that can be used, or no port left.
    pub fn new(domain: u16) -> Result<Self, DdsError> {
        let participant = DomainParticipant::new(domain).map_err(refused("join the network"))?;
        let none = QosPolicies::qos_none();
        let publisher = participant.create_publisher(&none).map_err(refused("publish"))?;
        let subscriber = participant.create_subscriber(&none).map_err(refused("subscribe"))?;
        Ok(Self { participant, publisher, subscriber })
    }

    /// Who publishes on topics of ROS 2 just now, this node left out.
    #[must_use]
    pub fn writers(&self) -> Vec<Writer> {
        let found = self.participant.discovered_writers();
        let mut writers: Vec<Writer> = found
            .into_iter()
            .filter_map(|found| {
                let data = &found.publication_topic_data;
                Some(Writer {
                    topic: ros_topic(&data.topic_name)?.to_owned(),
                    kind: ros_type(&data.type_name)?,
                    is_latched: !data.qos().is_volatile(),
                    is_reliable: data.qos().is_reliable(),
                    identity: found.writer_proxy.remote_writer_guid.to_bytes(),
                })
            })
            .collect();
        writers.sort();
        writers
    }

    /// Reads a topic, keeping the last `depth` messages. Writers that offer less than is asked for
    /// are not heard.
    ///
    /// # Errors
    /// A name that is no topic; what DDS refuses.
    pub fn subscribe(
        &self,
        topic: &str,
        kind: &str,
        durability: Durability,
        is_reliable: bool,
        depth: i32,
    ) -> Result<Subscription, DdsError> {
        let qos = requested(durability, is_reliable, depth);
        let topic = self.topic(topic, kind, &qos)?;
        let reader = self
            .subscriber
            .create_datareader_no_key::<Raw, AsIs>(&topic, Some(qos))
            .map_err(refused("read a topic"))?;
        Ok(Subscription { reader })
    }

    /// Writes a topic, keeping the last `depth` messages for whoever does not keep up, or, on a
    /// latched topic, comes late.
    ///
    /// # Errors
    /// A name that is no topic; what DDS or the operating system refuses.
    pub fn publish(
        &self,
        topic: &str,
        kind: &str,
        durability: Durability,
        depth: u8,
    ) -> Result<Publication, DdsError> {
        let qos = offered(durability, depth.into());
        let name = dds_topic(topic)?;
        let topic = self.topic(topic, kind, &qos)?;
        let writer = self
            .publisher
            .create_datawriter_no_key::<Raw, AsIs>(&topic, Some(qos))
            .map_err(refused("write a topic"))?;
        Publication::start(self.participant.clone(), name, writer, depth.into())
    }

    fn topic(&self, topic: &str, kind: &str, qos: &QosPolicies) -> Result<Topic, DdsError> {
        let name = dds_topic(topic)?;
        self.participant
            .create_topic(name, dds_type(kind), qos, TopicKind::NoKey)
            .map_err(refused("name a topic"))
    }
}

impl fmt::Debug for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Node").field("domain", &self.participant.domain_id()).finish()
    }
}

/// A topic that is read.
pub struct Subscription {
    reader: DataReader<Raw, AsIs>,
}

impl Subscription {
    /// The messages that came since the last call, oldest first, header included.
    pub fn take(&mut self) -> Vec<Vec<u8>> {
        let mut messages = Vec::new();
        // A sample that cannot be read is left out; its writer sends another.
        while let Ok(Some(sample)) = self.reader.take_next_sample() {
            messages.push(sample.into_value().0.into());
        }
        messages
    }
}

impl fmt::Debug for Subscription {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Subscription").finish_non_exhaustive()
    }
}

fn refused<E: fmt::Display>(action: &'static str) -> impl Fn(E) -> DdsError {
    move |cause| DdsError::Refused { action, cause: cause.to_string() }
}
