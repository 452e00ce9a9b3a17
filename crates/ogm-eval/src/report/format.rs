//! Numbers as the tables show them.

/// A squared error in px²: three significant digits are more than its interval bears.
pub(crate) fn px2(value: f64) -> String {
    if !value.is_finite() {
        "–".to_owned()
    } else if value >= 1000.0 {
        format!("{value:.0}")
    } else if value >= 10.0 {
        format!("{value:.1}")
    } else if value >= 0.1 || value == 0.0 {
        format!("{value:.2}")
    } else {
        format!("{value:.4}")
    }
}

/// An angle in degrees.
pub(crate) fn degrees(value: f64) -> String {
    format!("{value:.3}°")
}
