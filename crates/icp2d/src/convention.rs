//! The order of rotation and translation in print.

use nalgebra::Vector2;
use ogm_core::Se2;

/// The translation that, applied *before* the rotation, makes the same motion: R(−θ) t.
///
/// A [`Se2`] rotates, then translates. Tsardoulias et al., Eqs. 10–13, translate by the result of
/// ICP and rotate then; this is their T.
#[must_use]
pub fn translate_then_rotate(target_from_source: &Se2) -> Vector2<f64> {
    let turn_back = Se2::new(0.0, 0.0, -target_from_source.theta());
    turn_back * target_from_source.translation()
}
