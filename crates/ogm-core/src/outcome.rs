//! What a search gives back when its input was valid.

use crate::Refusal;

/// Either what was looked for, or why it cannot be said.
///
/// A valid map or tag set that holds too little is not an error and never an identity transform:
/// it is a refusal with its reason.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub enum Outcome<T> {
    /// What was looked for.
    Found(T),
    /// Valid input that does not determine an answer.
    Refused(Refusal),
}

impl<T> Outcome<T> {
    /// The result, if there is one.
    #[must_use]
    pub fn found(self) -> Option<T> {
        match self {
            Self::Found(value) => Some(value),
            Self::Refused(_) => None,
        }
    }

    /// The reason, if it was refused.
    #[must_use]
    pub fn refusal(&self) -> Option<&Refusal> {
        match self {
            Self::Found(_) => None,
            Self::Refused(refusal) => Some(refusal),
        }
    }

    /// The same outcome as a `Result`, for `?` inside a pipeline that refuses where a step does.
    ///
    /// # Errors
    /// The refusal.
    pub fn into_result(self) -> Result<T, Refusal> {
        match self {
            Self::Found(value) => Ok(value),
            Self::Refused(refusal) => Err(refusal),
        }
    }
}

impl<T> From<Result<T, Refusal>> for Outcome<T> {
    fn from(result: Result<T, Refusal>) -> Self {
        match result {
            Ok(value) => Self::Found(value),
            Err(refusal) => Self::Refused(refusal),
        }
    }
}
