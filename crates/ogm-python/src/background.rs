//! Long calls: on threads of their own, without the interpreter's lock, heard and ended by Python.

use std::error::Error;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use ogm_core::Progress;
use pyo3::exceptions::{PyRuntimeError, PyTypeError};
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyErr, PyResult, Python};
use rayon::ThreadPoolBuilder;

use crate::error::{MapError, map_error};

/// How often Python is told the share, and asked for signals.
const TICK: Duration = Duration::from_millis(50);
/// More threads than any machine has cores are a mistake.
const MAX_THREADS: usize = 1024;

/// How a call is run.
#[derive(Debug)]
pub(crate) struct Background {
    threads: usize,
    heard_by: Option<Py<PyAny>>,
}

impl Background {
    /// On `threads` threads, `None` for as many as there are cores; `progress` is called with the
    /// share that is done.
    pub(crate) fn new(
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        if let Some(threads) = threads.filter(|threads| !(1..=MAX_THREADS).contains(threads)) {
            let text = format!("threads must be 1 to {MAX_THREADS}, got {threads}");
            return Err(MapError::new_err(text));
        }
        if progress.as_ref().is_some_and(|progress| !progress.is_callable()) {
            return Err(PyTypeError::new_err("progress must be callable: progress(share)"));
        }
        Ok(Self { threads: threads.unwrap_or(0), heard_by: progress.map(Bound::unbind) })
    }

    /// Does `work` while other Python threads run.
    ///
    /// The calling thread waits; on it `progress` is called and signals are handled, so that
    /// Ctrl-C, or an exception in `progress`, ends the work and is raised. Every call has a pool of
    /// its own: a process that was forked has none of the threads of its parent.
    pub(crate) fn run<T: Send, E: Error + Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&dyn Progress) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        let watched = Watched::default();
        py.detach(|| {
            let pool = ThreadPoolBuilder::new().num_threads(self.threads).build();
            let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            thread::scope(|scope| {
                let (running, ended) = channel::<()>();
                let watched = &watched;
                let worker = scope.spawn(move || {
                    let _running = running;
                    pool.install(|| work(watched))
                });
                let mut raised = None;
                while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                    if raised.is_none() {
                        raised = Python::attach(|py| self.tell(py, watched)).err();
                        watched.cancelled.store(raised.is_some(), Ordering::Relaxed);
                    }
                }
                let done = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
                if let Some(raised) = raised {
                    return Err(raised);
                }
                let done = done.map_err(map_error)?;
                Python::attach(|py| self.tell(py, watched))?;
                Ok(done)
            })
        })
    }

    fn tell(&self, py: Python<'_>, watched: &Watched) -> Result<(), PyErr> {
        py.check_signals()?;
        if let Some(progress) = &self.heard_by {
            progress.call1(py, (watched.share(),))?;
        }
        Ok(())
    }
}

/// What a call says about itself, and whether it should end.
#[derive(Debug, Default)]
struct Watched {
    /// Bits of the largest share that was reported; those of numbers from 0 to 1 order as they do.
    share_bits: AtomicU64,
    cancelled: AtomicBool,
}

impl Watched {
    fn share(&self) -> f64 {
        f64::from_bits(self.share_bits.load(Ordering::Relaxed))
    }
}

impl Progress for Watched {
    fn report(&self, share: f64) {
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        self.share_bits.fetch_max(share.to_bits(), Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}
