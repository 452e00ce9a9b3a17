//! What the node says about itself, as `rqt_robot_monitor` shows it.

use ogm_io::ros::Header;
use serde::{Deserialize, Serialize};

/// `diagnostic_msgs/msg/DiagnosticArray`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct DiagnosticArray {
    /// When.
    pub header: Header,
    /// One a thing.
    pub status: Vec<DiagnosticStatus>,
}

impl DiagnosticArray {
    /// How ROS 2 names the type.
    pub const TYPE: &'static str = "diagnostic_msgs/msg/DiagnosticArray";

    /// Its definition, by which readers that know nothing of ROS decode it.
    pub const DEFINITION: &'static str = "\
std_msgs/Header header
diagnostic_msgs/DiagnosticStatus[] status
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: diagnostic_msgs/DiagnosticStatus
byte OK=0
byte WARN=1
byte ERROR=2
byte STALE=3
byte level
string name
string message
string hardware_id
diagnostic_msgs/KeyValue[] values
================================================================================
MSG: diagnostic_msgs/KeyValue
string key
string value
";
}

/// `diagnostic_msgs/msg/DiagnosticStatus`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct DiagnosticStatus {
    /// How bad.
    pub level: u8,
    /// Of what.
    pub name: String,
    /// In a sentence.
    pub message: String,
    /// Of which machine; empty here.
    pub hardware_id: String,
    /// In numbers.
    pub values: Vec<KeyValue>,
}

/// `diagnostic_msgs/msg/KeyValue`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeyValue {
    /// What.
    pub key: String,
    /// How much.
    pub value: String,
}

/// How bad a thing is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// As it should be.
    Ok,
    /// Someone should look.
    Warn,
    /// Something is refused.
    Error,
}

impl Level {
    /// The number of the message.
    #[must_use]
    pub fn byte(self) -> u8 {
        match self {
            Self::Ok => 0,
            Self::Warn => 1,
            Self::Error => 2,
        }
    }
}
