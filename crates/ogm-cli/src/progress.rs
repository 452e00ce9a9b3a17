//! A sign of life for what takes long.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use ogm_core::Progress;

use crate::interrupt::Listening;

/// Nothing is shown before this.
const PATIENCE: Duration = Duration::from_millis(500);
const TICK: Duration = Duration::from_millis(100);
/// Parts of the bar.
const PARTS: u64 = 1000;

/// Turns a wheel on standard error until it is dropped; only on a terminal, and only after half a
/// second.
#[derive(Debug)]
pub(crate) struct Wheel {
    /// Of [`PARTS`]; 0 where nothing is known.
    done: Arc<AtomicU64>,
    running: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Wheel {
    pub(crate) fn start(task: &'static str, quiet: bool) -> Self {
        let done = Arc::new(AtomicU64::new(0));
        if quiet || !std::io::stderr().is_terminal() {
            return Self { done, running: None };
        }
        let (sender, receiver) = channel::<()>();
        let shown = Arc::clone(&done);
        let thread = std::thread::spawn(move || {
            if receiver.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let wheel = ProgressBar::new_spinner().with_message(task);
            while receiver.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                draw(&wheel, shown.load(Ordering::Relaxed));
            }
            wheel.finish_and_clear();
        });
        Self { done, running: Some((sender, thread)) }
    }
}

/// A bar as soon as a share is known.
fn draw(wheel: &ProgressBar, done: u64) {
    if done > 0 && wheel.length().is_none() {
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {wide_bar} {percent:>3} %")
        {
            wheel.set_style(style);
        }
        wheel.set_length(PARTS);
    }
    if done > 0 {
        wheel.set_position(done);
    }
    wheel.tick();
}

impl Drop for Wheel {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.running.take() {
            drop(sender);
            // A wheel that broke is not worth a word.
            let _ = thread.join();
        }
    }
}

/// A wheel that knows how far the work is, and that Ctrl-C can end.
#[derive(Debug)]
pub(crate) struct Bar {
    wheel: Wheel,
    listening: Listening,
}

impl Bar {
    pub(crate) fn start(task: &'static str, quiet: bool) -> Self {
        Self { wheel: Wheel::start(task, quiet), listening: Listening::start() }
    }
}

impl Progress for Bar {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to PARTS")]
    fn report(&self, share: f64) {
        let done = (share.clamp(0.0, 1.0) * PARTS as f64) as u64;
        self.wheel.done.fetch_max(done, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.listening.is_asked_to_end()
    }
}
