//! The same work with and without threads.

/// `f` of every item, in the order of the items.
#[cfg(feature = "rayon")]
pub(crate) fn map_in_order<T: Sync, U: Send>(
    items: &[T],
    f: impl Fn(&T) -> U + Send + Sync,
) -> Vec<U> {
    use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
    items.par_iter().map(f).collect()
}

/// `f` of every item, in the order of the items.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map_in_order<T, U>(items: &[T], f: impl Fn(&T) -> U) -> Vec<U> {
    items.iter().map(f).collect()
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
pub(crate) fn both<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}
