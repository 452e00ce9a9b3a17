//! Poses as people write them.

use std::str::FromStr;

use ogm_core::Se2;
use ogm_merge::PoseDegrees;

/// `ROBOT=X,Y,DEG`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct InitPose {
    pub(crate) robot: String,
    pub(crate) world_from_map: Se2,
}

impl FromStr for InitPose {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || "write ROBOT=X,Y,DEG: metres, metres, degrees".to_owned();
        let (robot, numbers) = text.split_once('=').ok_or_else(form)?;
        let [x_m, y_m, theta_deg] = numbers_in(numbers).ok_or_else(form)?;
        let robot = robot.trim_matches('/').to_owned();
        Ok(Self { robot, world_from_map: PoseDegrees { x_m, y_m, theta_deg }.into() })
    }
}

/// `M,DEG`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sigma {
    pub(crate) sigma_m: f64,
    pub(crate) sigma_rad: f64,
}

impl FromStr for Sigma {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [sigma_m, degrees] =
            numbers_in(text).ok_or_else(|| "write M,DEG: metres, degrees".to_owned())?;
        Ok(Self { sigma_m, sigma_rad: degrees.to_radians() })
    }
}

fn numbers_in<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers = text.split(',').map(|number| number.trim().parse().ok());
    numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()
}
