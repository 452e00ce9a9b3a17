//! The proof: everything of the workspace that measures.

#![expect(
    clippy::disallowed_methods,
    reason = "this is where files are written and time is measured"
)]
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "it talks to a person at a terminal"
)]

pub mod compare;
mod draw;
pub mod fixtures;
mod map_pair;
pub mod race;
mod report;
mod stats;
