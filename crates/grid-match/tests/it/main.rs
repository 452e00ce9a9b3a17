//! What a user of the matcher would notice.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bent;
mod bounds;
mod metamorphic;
mod progress;
mod refusals;
mod simulated;
mod styles;
#[cfg(feature = "rayon")]
mod threads;
mod world;
