//! The robot and its noise.

use ogm_core::{ParameterError, require};

/// The robot and its noise; the paper prints none of these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EkfParams {
    /// Distance between the wheels, metres: 0.35, a robot of the size that carries a laser indoors.
    pub track_m: f64,
    /// Standard deviation of a wheel's travel after one metre, metres; its variance grows with the
    /// travel: 0.02, wheel slip of two per cent of a metre.
    pub wheel_sigma_per_root_m: f64,
    /// Standard deviation of a yaw rate, radians a second: 0.01, MEMS noise at some ten hertz.
    pub yaw_rate_sigma: f64,
    /// Standard deviation of the gyroscope's bias at the start, radians a second: 0.01, about
    /// half a degree a second, as a MEMS gyroscope has before it is warm.
    pub bias_sigma: f64,
    /// Growth of the bias's standard deviation in the root of a second: 1e-4, a degree a second
    /// within hours.
    pub bias_walk: f64,
    /// Squared Mahalanobis distance beyond which a scan match is left out: 30.66, which one right
    /// one in a million exceeds (χ² of three degrees of freedom). A narrow gate drops right
    /// readings just where the wheels erred most, and then nothing makes that up.
    pub scan_gate: f64,
    /// The same for a yaw rate: 23.93 (χ² of one degree of freedom).
    pub imu_gate: f64,
    /// Longest time without a reading, seconds: 5, in which a robot that moves is lost.
    pub max_gap_s: f64,
}

impl Default for EkfParams {
    fn default() -> Self {
        Self {
            track_m: 0.35,
            wheel_sigma_per_root_m: 0.02,
            yaw_rate_sigma: 0.01,
            bias_sigma: 0.01,
            bias_walk: 1e-4,
            scan_gate: 30.66,
            imu_gate: 23.93,
            max_gap_s: 5.0,
        }
    }
}

impl EkfParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let positive = |name, value: f64| {
            require(value > 0.0 && value.is_finite(), name, "finite and above 0", value)
        };
        let not_negative = |name, value: f64| {
            require(value >= 0.0 && value.is_finite(), name, "finite and at least 0", value)
        };
        positive("track_m", self.track_m)?;
        not_negative("wheel_sigma_per_root_m", self.wheel_sigma_per_root_m)?;
        positive("yaw_rate_sigma", self.yaw_rate_sigma)?;
        not_negative("bias_sigma", self.bias_sigma)?;
        not_negative("bias_walk", self.bias_walk)?;
        positive("scan_gate", self.scan_gate)?;
        positive("imu_gate", self.imu_gate)?;
        positive("max_gap_s", self.max_gap_s)
    }
}
