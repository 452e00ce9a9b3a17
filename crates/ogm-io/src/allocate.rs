//! Room for what a file says it holds, or an error where there is none.

use crate::MapImageError;

/// An empty vector with room for `count` items.
pub(crate) fn room<T>(count: usize) -> Result<Vec<T>, MapImageError> {
    let mut items = Vec::new();
    let bytes = count.saturating_mul(size_of::<T>());
    items.try_reserve_exact(count).map_err(|_no_room| MapImageError::OutOfMemory { bytes })?;
    Ok(items)
}

/// `count` zero bytes.
pub(crate) fn zeroes(count: usize) -> Result<Vec<u8>, MapImageError> {
    let mut bytes = room(count)?;
    bytes.resize(count, 0);
    Ok(bytes)
}
