//! The knobs of a session.

use ogm_core::{ParameterError, Se2, require};

use crate::{AlignParams, MergeError};

/// How a session merges.
#[derive(Debug, Clone)]
pub struct SessionParams {
    /// How pairs are searched, and the probability that a join must reach
    /// ([`MatchParams::accept`](crate::MatchParams::accept)). A `prior` in it is not used.
    pub align: AlignParams,
    /// A pair is searched again once this share of what either robot knew has changed since: 0.05.
    /// One that has no place yet but a pose that is likelier than not is searched at any change.
    pub changed_share: f64,
    /// By how much another arrangement must be the better one before it replaces that which
    /// stands, in log-odds of what the walls say: 3.
    pub lead: f64,
}

impl Default for SessionParams {
    fn default() -> Self {
        Self { align: AlignParams::default(), changed_share: 0.05, lead: 3.0 }
    }
}

impl SessionParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        for (name, value) in [("changed_share", self.changed_share), ("lead", self.lead)] {
            require(value.is_finite() && value >= 0.0, name, "finite and not below 0", value)?;
        }
        Ok(())
    }
}

/// Where a robot's map lies in the world, and how far to believe it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RobotPrior {
    /// Maps its points into the world.
    pub world_from_map: Se2,
    /// Standard deviation of its translation, metres; 0, of the rotation too, pins the map there:
    /// nothing is searched and nothing is doubted.
    pub sigma_m: f64,
    /// Standard deviation of its rotation, radians.
    pub sigma_rad: f64,
}

impl RobotPrior {
    pub(crate) fn is_given(&self) -> bool {
        self.sigma_m == 0.0 && self.sigma_rad == 0.0
    }

    pub(crate) fn check(&self) -> Result<(), MergeError> {
        self.world_from_map.check_finite()?;
        for (name, value) in [("prior.sigma_m", self.sigma_m), ("prior.sigma_rad", self.sigma_rad)]
        {
            require(value.is_finite() && value >= 0.0, name, "finite and not below 0", value)?;
        }
        Ok(())
    }
}
