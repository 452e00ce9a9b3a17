//! When two poses are two answers.

/// Poses further apart than this at the centre of the second map are different answers, metres.
pub(crate) const MODE_M: f64 = 0.75;
/// Poses turned further apart than this are different answers, radians.
pub(crate) const MODE_RAD: f64 = 0.1;
