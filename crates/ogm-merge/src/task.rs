//! What a recipe by tags works on.

use ogm_core::Progress;

use crate::{RfidParams, RobotMap};

/// Two robots, and how they are to be aligned.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) target: &'a RobotMap<'a>,
    pub(crate) source: &'a RobotMap<'a>,
    pub(crate) params: &'a RfidParams,
    pub(crate) progress: &'a dyn Progress,
}
