//! What stops the live merging.

use ogm_io::ros::MessageError;
use ogm_merge::{MergeError, ResumeError};

/// Parameters or saved states that cannot be meant; what robots send never is one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LiveError {
    /// Parameters outside their range, or a call that was cancelled.
    #[error(transparent)]
    Merge(#[from] MergeError),
    /// A saved state.
    #[error(transparent)]
    Resume(#[from] ResumeError),
    /// An answer that fits no message.
    #[error(transparent)]
    Message(#[from] MessageError),
}
