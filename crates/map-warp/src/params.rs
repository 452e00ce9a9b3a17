//! What drift can do to a map.

use ogm_core::{ParameterError, require};

/// What drift can do to a map, and when a motion is not believed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WarpParams {
    /// Standard deviation along an axis of how far drift displaces a place from where the rigid
    /// motion of the whole map puts it, metres. 0.3: patches of real pairs were seen up to half a
    /// metre off.
    pub drift_sigma_m: f64,
    /// Distance over which that displacement stays alike, metres: at this distance the correlation
    /// is 0.6. 5: a room is nearly rigid.
    pub correlation_m: f64,
    /// Standard deviations by which a motion may differ from what the others say there, before it is
    /// taken as a lie. 4: of three numbers, one in a thousand.
    pub outlier_sigmas: f64,
}

impl Default for WarpParams {
    fn default() -> Self {
        Self { drift_sigma_m: 0.3, correlation_m: 5.0, outlier_sigmas: 4.0 }
    }
}

impl WarpParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let Self { drift_sigma_m: drift, correlation_m: correlation, outlier_sigmas } = *self;
        let lies_within = |value: f64| (1e-3..=1e3).contains(&value);
        require(lies_within(drift), "drift_sigma_m", "in [0.001, 1000]", drift)?;
        require(lies_within(correlation), "correlation_m", "in [0.001, 1000]", correlation)?;
        require(outlier_sigmas >= 1.0, "outlier_sigmas", "at least 1", outlier_sigmas)
    }
}
