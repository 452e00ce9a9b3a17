//! Merges the maps of a running ROS 2 robot team, live or from a bag, without a ROS installation.
//!
//! [`live::Live`] is the merging without network and clock: bytes of messages in, bytes of messages
//! out. [`dds::Node`] is the network, [`recorder::Recorder`] a bag of what is published; the command
//! `ogm-ros` ties them together.

pub mod dds;
pub mod live;
pub mod message;
pub mod recorder;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
