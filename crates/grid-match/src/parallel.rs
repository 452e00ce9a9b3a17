//! Work on all cores where the feature `rayon` is on; the answers are the same without.

use ogm_core::Cancelled;

/// `of` each item, in their order; what `scratch` makes is used for one item after the other.
#[cfg(feature = "rayon")]
pub(crate) fn each<T: Sync, R: Send, S: Send>(
    items: &[T],
    scratch: impl Fn() -> S + Sync + Send,
    of: impl Fn(&mut S, &T) -> Result<R, Cancelled> + Sync + Send,
) -> Result<Vec<R>, Cancelled> {
    use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
    items.par_iter().map_init(scratch, of).collect()
}

/// `of` each item, in their order; what `scratch` makes is used for one item after the other.
#[cfg(not(feature = "rayon"))]
pub(crate) fn each<T: Sync, R: Send, S: Send>(
    items: &[T],
    scratch: impl Fn() -> S + Sync + Send,
    of: impl Fn(&mut S, &T) -> Result<R, Cancelled> + Sync + Send,
) -> Result<Vec<R>, Cancelled> {
    let mut scratch = scratch();
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
