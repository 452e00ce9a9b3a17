//! Ctrl-C and SIGTERM as a clean end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context;
use ogm_core::Progress;

/// Whether somebody asked for the end.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Listens to the signals of this process.
    pub(crate) fn on_signals() -> anyhow::Result<Self> {
        let stop = Self::default();
        let flag = Arc::clone(&stop.0);
        ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
            .context("cannot listen to signals")?;
        Ok(stop)
    }

    pub(crate) fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Progress for Stop {
    fn report(&self, _share: f64) {}

    fn is_cancelled(&self) -> bool {
        self.is_asked()
    }
}
