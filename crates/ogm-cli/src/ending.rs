//! How a command ended that could do its work.

/// What the exit code says of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    Done,
    Refused,
}
