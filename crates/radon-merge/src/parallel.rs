//! The same work with and without threads.

/// `f` of every item and its index, in the order of the items.
#[cfg(feature = "rayon")]
pub(crate) fn map_in_order<T: Sync, U: Send>(
    items: &[T],
    f: impl Fn(usize, &T) -> U + Sync,
) -> Vec<U> {
    use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
    items.par_iter().enumerate().map(|(index, item)| f(index, item)).collect()
}

/// `f` of every item and its index, in the order of the items.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map_in_order<T, U>(items: &[T], f: impl Fn(usize, &T) -> U) -> Vec<U> {
    items.iter().enumerate().map(|(index, item)| f(index, item)).collect()
}
