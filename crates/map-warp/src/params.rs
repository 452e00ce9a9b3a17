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
    /// Standard deviation along an axis of what displaces a wall besides, metres; 0, none. A scan is
    /// displaced in one piece, so walls of one room that were seen from different places are
    /// displaced apart.
    pub detail_sigma_m: f64,
    /// Distance over which that stays alike, metres.
    pub detail_m: f64,
    /// Standard deviations by which a motion may differ from what the others say there, before it is
    /// taken as a lie. 4: of three numbers, one in a thousand.
    pub outlier_sigmas: f64,
}

impl Default for WarpParams {
    fn default() -> Self {
        Self {
            drift_sigma_m: 0.3,
            correlation_m: 5.0,
            detail_sigma_m: 0.0,
            detail_m: 2.0,
            outlier_sigmas: 4.0,
        }
    }
}

impl WarpParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let Self { drift_sigma_m, correlation_m, detail_sigma_m, detail_m, outlier_sigmas } = *self;
        let lies_within = |value: f64| (1e-3..=1e3).contains(&value);
        let lengths = [
            ("drift_sigma_m", drift_sigma_m),
            ("correlation_m", correlation_m),
            ("detail_m", detail_m),
        ];
        for (name, length) in lengths {
            require(lies_within(length), name, "in [0.001, 1000]", length)?;
        }
        let is_detail = (0.0..=1e3).contains(&detail_sigma_m);
        require(is_detail, "detail_sigma_m", "in [0, 1000]", detail_sigma_m)?;
        require(outlier_sigmas >= 1.0, "outlier_sigmas", "at least 1", outlier_sigmas)
    }
}
