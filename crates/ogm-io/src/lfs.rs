//! Git LFS pointers: what lies in a clone instead of a large file until it is fetched.

/// Whether `bytes` are a pointer, after the Git LFS specification, version 1.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    bytes.starts_with(b"version https://git-lfs") || bytes.starts_with(b"version https://hawser")
}
