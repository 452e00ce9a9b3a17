//! Places in a text.

/// The line of a byte, from 1.
pub(super) fn line_number(text: &str, position: usize) -> usize {
    text[..position].matches('\n').count() + 1
}
