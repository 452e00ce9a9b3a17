//! How a bent map is made straight, and when that is believed.

use map_warp::WarpParams;
use ogm_core::{ClassThresholds, ParameterError, require};

/// How a map is bent onto another, and when that is believed.
#[derive(Debug, Clone, Copy)]
pub struct BendParams {
    /// What drift can do to a map: 0.3 m that are alike over 12 m, and 0.05 m over 2 m, for walls of
    /// one room that were seen from different places are displaced apart; see `docs/bend.md`.
    pub warp: WarpParams,
    /// Least standard scores by which walls that were held out of the fit must lie better than
    /// under a rigid motion: 2.5, by chance less than one map in a hundred.
    pub significance: f64,
    /// What counts as occupied and free.
    pub thresholds: ClassThresholds,
}

impl Default for BendParams {
    fn default() -> Self {
        let warp =
            WarpParams { correlation_m: 12.0, detail_sigma_m: 0.05, ..WarpParams::default() };
        Self { warp, significance: 2.5, thresholds: ClassThresholds::default() }
    }
}

impl BendParams {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let significance = self.significance;
        require(significance >= 0.0, "significance", "at least 0", significance)
    }
}
