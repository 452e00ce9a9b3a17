//! Poses as people write them: metres and degrees.

use std::str::FromStr;

use ogm_core::Se2;
use ogm_merge::PoseDegrees;

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

/// The transform written `X,Y,DEG`.
pub(crate) fn transform(text: &str) -> Result<Se2, String> {
    let [x_m, y_m, theta_deg] = numbers(text, "X,Y,DEG")?;
    Ok(PoseDegrees { x_m, y_m, theta_deg }.into())
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
