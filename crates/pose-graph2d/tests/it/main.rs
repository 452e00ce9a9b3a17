//! What a solved graph promises.
#![expect(clippy::unwrap_used, reason = "a test fails where it cannot go on")]

mod certified;
mod covariances;
mod files;
mod malformed;
mod selection;
mod world;
