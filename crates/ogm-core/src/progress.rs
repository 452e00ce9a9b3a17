//! How far a long call has come, and whether anybody still waits for it.

use std::sync::atomic::{AtomicUsize, Ordering};

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

    /// Part `index`, from 0, of `count` equal parts.
    #[must_use]
    pub fn nth(whole: &'a dyn Progress, index: usize, count: usize) -> Self {
        let share = |parts: usize| parts as f64 / count.max(1) as f64;
        Self { whole, from: share(index), to: share(index + 1) }
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

/// A call made of so many equal steps, done in any order and by any number of threads.
#[derive(Debug)]
pub struct Steps<'a> {
    whole: Stage<'a>,
    count: usize,
    done: AtomicUsize,
}

impl<'a> Steps<'a> {
    /// `count` steps that make up all of `whole`.
    #[must_use]
    pub fn new(whole: &'a dyn Progress, count: usize) -> Self {
        Self { whole: Stage::new(whole, 0.0, 1.0), count, done: AtomicUsize::new(0) }
    }

    /// One more step is done.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn step(&self) -> Result<(), Cancelled> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.whole.go_on(done as f64 / self.count as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::{Progress, Stage, Steps};
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
        let half = Stage::nth(&heard, 1, 2);
        for share in [0.0, 1.0] {
            Stage::new(&half, 0.5, 1.0).report(share);
        }
        assert_eq!(*heard.0.lock().unwrap(), [0.75, 1.0]);
    }

    #[test]
    fn steps_of_several_threads_add_up_to_the_whole() {
        let heard = Heard::default();
        let steps = Steps::new(&heard, 8);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| (0..2).for_each(|_| steps.step().unwrap()));
            }
        });
        let mut shares = heard.0.lock().unwrap().clone();
        shares.sort_by(f64::total_cmp);
        assert_eq!(shares, [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
    }
}
