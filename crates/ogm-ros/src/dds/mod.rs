//! The thin edge to the network: bytes of messages in and out by DDS, named as ROS 2 names them.

mod error;
mod fragments;
mod names;
mod node;
mod pacing;
mod publication;
mod qos;
mod raw;

pub use error::DdsError;
pub use node::{Node, Subscription, Writer};
pub use publication::Publication;
pub use qos::Durability;
