//! Poses as people write them: metres and degrees.

use std::fmt;
use std::str::FromStr;

use ogm_core::Se2;
use serde::Serialize;

/// A pose or transform on the command line and in JSON.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Pose {
    pub(crate) x_m: f64,
    pub(crate) y_m: f64,
    pub(crate) theta_deg: f64,
}

impl From<Se2> for Pose {
    fn from(a_from_b: Se2) -> Self {
        // Adding zero turns -0.0 into 0.0.
        Self {
            x_m: a_from_b.x() + 0.0,
            y_m: a_from_b.y() + 0.0,
            theta_deg: a_from_b.theta().to_degrees() + 0.0,
        }
    }
}

impl From<Pose> for Se2 {
    fn from(pose: Pose) -> Self {
        Self::new(pose.x_m, pose.y_m, pose.theta_deg.to_radians())
    }
}

/// To the millimetre and the hundredth of a degree.
impl fmt::Display for Pose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = [self.x_m, self.y_m].map(|metres| rounded(metres, 3));
        write!(f, "x {x:.3} m, y {y:.3} m, theta {:.2} deg", rounded(self.theta_deg, 2))
    }
}

/// Rounded, and never a negative zero.
fn rounded(value: f64, digits: i32) -> f64 {
    let scale = 10_f64.powi(digits);
    (value * scale).round() / scale + 0.0
}

impl FromStr for Pose {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let [x_m, y_m, theta_deg] = numbers(text, "X,Y,DEG")?;
        Ok(Self { x_m, y_m, theta_deg })
    }
}

/// How far to believe a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sigma {
    pub(crate) metres: f64,
    pub(crate) degrees: f64,
}

impl FromStr for Sigma {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let [metres, degrees] = numbers(text, "M,DEG")?;
        if metres < 0.0 || degrees < 0.0 {
            return Err("a standard deviation is not negative".to_owned());
        }
        Ok(Self { metres, degrees })
    }
}

/// `N` finite numbers with commas between them.
fn numbers<const N: usize>(text: &str, form: &str) -> Result<[f64; N], String> {
    let values: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse().ok().filter(|value: &f64| value.is_finite()))
        .collect();
    values
        .and_then(|values| values.try_into().ok())
        .ok_or_else(|| format!("write {form}: {N} finite numbers with commas between them"))
}
