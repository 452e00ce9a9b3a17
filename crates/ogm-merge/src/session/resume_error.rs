//! Why saved data is no session.

use ogm_core::GridError;

/// The form that is written.
pub(crate) const VERSION: u32 = 1;

/// Why saved data is no session.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResumeError {
    /// Another form than this one.
    #[error("a session saved in form {found}, where form {VERSION} is read; start a new session")]
    Version {
        /// The form that was found.
        found: u32,
    },
    /// A map that cannot be.
    #[error("the saved map of robot '{robot}' cannot be: {why}")]
    Map {
        /// Whose.
        robot: String,
        /// What is wrong.
        why: GridError,
    },
    /// Numbers that contradict each other.
    #[error("a saved session that contradicts itself ({0}); start a new session")]
    Inconsistent(&'static str),
}
