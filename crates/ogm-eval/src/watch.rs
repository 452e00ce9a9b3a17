//! How far a run has come, for whoever waits.

use std::fmt::Debug;

/// Hears of a run that takes minutes: stages of a known length, one after the other.
pub trait Watch: Debug + Send + Sync {
    /// A stage of `length` steps begins.
    fn begin(&self, label: &'static str, length: u64);

    /// One step of the stage is done; called from many threads.
    fn step(&self);

    /// The stage is done.
    fn end(&self);
}

impl Watch for () {
    fn begin(&self, _label: &'static str, _length: u64) {}

    fn step(&self) {}

    fn end(&self) {}
}
