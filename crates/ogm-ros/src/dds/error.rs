//! Why the network is out of reach.

/// What DDS refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DdsError {
    /// No participant, topic, reader or writer.
    #[error("DDS cannot {action}: {cause}; is a network interface up that multicasts?")]
    Refused {
        /// What was asked for.
        action: &'static str,
        /// Its words.
        cause: String,
    },
    /// A name that ROS 2 does not allow.
    #[error("\"{name}\" is no topic; write /name or /namespace/name")]
    Topic {
        /// What was asked for.
        name: String,
    },
    /// A thread or a socket.
    #[error("the operating system refused {what}: {cause}")]
    System {
        /// Which.
        what: &'static str,
        /// Why.
        cause: std::io::Error,
    },
}
