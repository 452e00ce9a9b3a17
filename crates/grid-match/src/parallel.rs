//! Work on all cores where the feature `rayon` is on; the answers are the same without.

use ogm_core::Cancelled;

/// `of` each item, in their order.
pub(crate) fn each<T: Sync, R: Send>(
    items: &[T],
    of: impl Fn(&T) -> Result<R, Cancelled> + Sync + Send,
) -> Result<Vec<R>, Cancelled> {
    each_with(items, Vec::new(), || (), |(), item| of(item))
}

/// `of` each item, in their order; what is `idle`, and then what `scratch` makes, is used for one
/// item after the other.
#[cfg(feature = "rayon")]
pub(crate) fn each_with<T: Sync, R: Send, S: Send>(
    items: &[T],
    idle: Vec<S>,
    scratch: impl Fn() -> S + Sync + Send,
    of: impl Fn(&mut S, &T) -> Result<R, Cancelled> + Sync + Send,
) -> Result<Vec<R>, Cancelled> {
    use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
    use std::sync::{Mutex, PoisonError};

    // Rayon makes a scratch for each piece of the work, of which there are more than threads.
    let idle = Mutex::new(idle);
    let idle = || idle.lock().unwrap_or_else(PoisonError::into_inner);
    let with_scratch = |item| {
        let taken = idle().pop();
        let mut own = taken.unwrap_or_else(&scratch);
        let result = of(&mut own, item);
        idle().push(own);
        result
    };
    items.par_iter().map(with_scratch).collect()
}

/// `of` each item, in their order; what is `idle`, and then what `scratch` makes, is used for one
/// item after the other.
#[cfg(not(feature = "rayon"))]
pub(crate) fn each_with<T: Sync, R: Send, S: Send>(
    items: &[T],
    mut idle: Vec<S>,
    scratch: impl Fn() -> S + Sync + Send,
    of: impl Fn(&mut S, &T) -> Result<R, Cancelled> + Sync + Send,
) -> Result<Vec<R>, Cancelled> {
    let mut scratch = idle.pop().unwrap_or_else(scratch);
    items.iter().map(|item| of(&mut scratch, item)).collect()
}

/// What both give.
#[cfg(feature = "rayon")]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// What both give.
#[cfg(not(feature = "rayon"))]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    (first(), second())
}
