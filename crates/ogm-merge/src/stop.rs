//! Why a recipe ends early: a refusal is an outcome, an error is not.

use ogm_core::{Cancelled, Refusal};

use crate::MergeError;

/// Lets `?` leave a recipe with either.
#[derive(Debug)]
pub(crate) enum Stop {
    Refused(Refusal),
    Error(MergeError),
}

impl From<Refusal> for Stop {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<rfid_loc::TagError> for Stop {
    fn from(error: rfid_loc::TagError) -> Self {
        Self::Error(error.into())
    }
}

impl From<icp2d::IcpError> for Stop {
    fn from(error: icp2d::IcpError) -> Self {
        Self::Error(error.into())
    }
}

impl From<Cancelled> for Stop {
    fn from(cancelled: Cancelled) -> Self {
        Self::Error(cancelled.into())
    }
}
