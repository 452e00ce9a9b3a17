//! What a user of the alignment would notice.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod metamorphic;
mod numbered;
mod plain;
mod refusals;
mod start;
mod walls;
