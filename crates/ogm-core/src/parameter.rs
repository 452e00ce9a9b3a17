//! Parameters outside their range.

/// A parameter that is not what it must be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{name} must be {requirement}, got {value}")]
pub struct ParameterError {
    /// The field, with the names of the structs around it where they help.
    pub name: &'static str,
    /// What it must be.
    pub requirement: &'static str,
    /// What was given.
    pub value: f64,
}

/// That what a parameter must be `holds`.
///
/// ```
/// use ogm_core::{ParameterError, require};
///
/// fn check(accept: f64) -> Result<(), ParameterError> {
///     require(accept > 0.0 && accept <= 1.0, "accept", "above 0 and at most 1", accept)
/// }
/// let error = check(f64::NAN).unwrap_err();
/// assert_eq!(error.to_string(), "accept must be above 0 and at most 1, got NaN");
/// ```
///
/// # Errors
/// If it does not.
pub fn require(
    holds: bool,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<(), ParameterError> {
    if holds { Ok(()) } else { Err(ParameterError { name, requirement, value }) }
}
