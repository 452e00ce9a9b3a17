//! How far a long call has come, and whether anybody still waits for it.

/// Hears how far a call has come and says whether to go on.
///
/// Calls that may take over half a second take one. They report from several threads, in no order
/// and not at equal intervals; the share never says more than has been done. `()` hears nothing
/// and always goes on.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
/// use ogm_core::{Cancelled, Progress};
///
/// struct Stop(AtomicBool);
/// impl Progress for Stop {
///     fn report(&self, _share: f64) {}
///     fn is_cancelled(&self) -> bool {
///         self.0.load(Ordering::Relaxed)
///     }
/// }
///
/// assert_eq!(Stop(AtomicBool::new(true)).go_on(0.5), Err(Cancelled));
/// assert_eq!(().go_on(0.5), Ok(()));
/// ```
pub trait Progress: Sync {
    /// The call has come this far, from 0 to 1.
    fn report(&self, share: f64);

    /// Whether the call should end as soon as it can.
    fn is_cancelled(&self) -> bool;

    /// Reports `share`, and ends the call with `?` if it was cancelled.
    ///
    /// # Errors
    /// [`Cancelled`].
    fn go_on(&self, share: f64) -> Result<(), Cancelled> {
        self.report(share);
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

impl Progress for () {
    fn report(&self, _share: f64) {}

    fn is_cancelled(&self) -> bool {
        false
    }
}

/// A call that ended early because it was asked to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// A part of a longer call as a call of its own.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    whole: &'a dyn Progress,
    from: f64,
    to: f64,
}

impl<'a> Stage<'a> {
    /// The part of `whole` between two shares of it.
    #[must_use]
    pub fn new(whole: &'a dyn Progress, from: f64, to: f64) -> Self {
        Self { whole, from, to }
    }
}

impl std::fmt::Debug for Stage<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Stage({}..{})", self.from, self.to)
    }
}

impl Progress for Stage<'_> {
    fn report(&self, share: f64) {
        self.whole.report(self.from + share.clamp(0.0, 1.0) * (self.to - self.from));
    }

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::{Progress, Stage};
    use std::sync::Mutex;

    #[derive(Default)]
    struct Heard(Mutex<Vec<f64>>);

    impl Progress for Heard {
        fn report(&self, share: f64) {
            self.0.lock().unwrap().push(share);
        }

        fn is_cancelled(&self) -> bool {
            false
        }
    }

    #[test]
    fn stages_inside_stages_fill_their_part_of_the_whole() {
        let heard = Heard::default();
        let half = Stage::new(&heard, 0.5, 1.0);
        for share in [0.0, 1.0] {
            Stage::new(&half, 0.5, 1.0).report(share);
        }
        assert_eq!(*heard.0.lock().unwrap(), [0.75, 1.0]);
    }
}
