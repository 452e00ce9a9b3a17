//! What is wrong with a bag.

use crate::ros::MessageError;

/// A bag that cannot be read or written, or that lacks what was asked for.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BagError {
    /// Neither MCAP nor SQLite, nor a folder of them.
    #[error("neither an MCAP nor a SQLite bag, nor a folder of one")]
    NotABag,
    /// The file cannot be read on.
    #[error(
        "as {format}: {message}; a recorder that was killed leaves such files: `mcap recover` or `ros2 bag reindex` may help"
    )]
    Damaged {
        /// `MCAP` or `SQLite`.
        format: &'static str,
        /// What the reader says.
        message: String,
    },
    /// Messages that are compressed one by one, or in another encoding than CDR.
    #[error(
        "topic {topic} is in encoding \"{encoding}\"; only cdr is read; `ros2 bag convert` rewrites a bag"
    )]
    Encoding {
        /// The topic.
        topic: String,
        /// Its encoding.
        encoding: String,
    },
    /// No map on the topic.
    #[error("no map on topic {topic}{}", maps(have))]
    NoMap {
        /// What was asked for.
        topic: String,
        /// The topics that have maps.
        have: Vec<String>,
    },
    /// No map so early.
    #[error(
        "the first map on topic {topic} is {first_s:.3} s after the bag's start, not by {asked_s} s"
    )]
    TooEarly {
        /// The topic.
        topic: String,
        /// Seconds from the start of the bag that were asked for.
        asked_s: f64,
        /// Seconds from there to the first map.
        first_s: f64,
    },
    /// A message that is no map.
    #[error(transparent)]
    Message(#[from] MessageError),
    /// The bag cannot be written.
    #[error("cannot write it: {message}")]
    Write {
        /// What the writer says.
        message: String,
    },
}

fn maps(have: &[String]) -> String {
    if have.is_empty() {
        ", nor on any other".to_owned()
    } else {
        format!("; there are maps on {}", have.join(", "))
    }
}
