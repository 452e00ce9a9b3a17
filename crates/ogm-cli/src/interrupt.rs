//! Ctrl-C: ends what can be ended cleanly, and the rest at once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use anyhow::Context;

/// Exit code of a command that was ended by Ctrl-C, 128 and the number of the signal.
pub(crate) const EXIT_CODE: u8 = 130;

static ASKED: AtomicBool = AtomicBool::new(false);
static LISTENING: AtomicUsize = AtomicUsize::new(0);

/// From here on Ctrl-C is a request to whoever listens; the second one ends the process.
pub(crate) fn install() -> anyhow::Result<()> {
    ctrlc::set_handler(|| {
        let was_asked = ASKED.swap(true, Ordering::SeqCst);
        if was_asked || LISTENING.load(Ordering::SeqCst) == 0 {
            std::process::exit(EXIT_CODE.into());
        }
    })
    .context("cannot listen to Ctrl-C")
}

/// Work that asks now and then whether to go on, for as long as this lives.
#[derive(Debug)]
pub(crate) struct Listening(());

impl Listening {
    pub(crate) fn start() -> Self {
        LISTENING.fetch_add(1, Ordering::SeqCst);
        Self(())
    }

    /// Whether somebody pressed Ctrl-C.
    pub(crate) fn is_asked_to_end(&self) -> bool {
        ASKED.load(Ordering::SeqCst)
    }
}

impl Drop for Listening {
    fn drop(&mut self) {
        LISTENING.fetch_sub(1, Ordering::SeqCst);
    }
}
