//! What a bag is made of.

/// A message of a bag.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BagMessage {
    /// The topic, such as `/robot1/map`.
    pub topic: String,
    /// Its type, such as `nav_msgs/msg/OccupancyGrid`.
    pub kind: String,
    /// When it was received, nanoseconds since the epoch.
    pub log_time_ns: u64,
    /// Its bytes, header included.
    pub data: Vec<u8>,
}
