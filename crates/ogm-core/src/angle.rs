//! Angles on a circle: wrapping, undirected differences, and means of k-fold symmetric directions.

use std::f64::consts::{PI, TAU};

/// Wraps `angle` into [−π, π).
#[must_use]
pub fn wrap_angle(angle: f64) -> f64 {
    wrap_period(angle, TAU)
}

/// Wraps `value` into [−period/2, period/2); the unit is the caller's.
///
/// Non-finite input gives NaN.
#[must_use]
pub fn wrap_period(value: f64, period: f64) -> f64 {
    let half = period / 2.0;
    let wrapped = (value + half).rem_euclid(period) - half;
    // rem_euclid rounds up to `period` itself for tiny negative remainders.
    if wrapped >= half { -half } else { wrapped }
}

/// The angle between two undirected lines, in [0, π/2].
#[must_use]
pub fn undirected_difference(a: f64, b: f64) -> f64 {
    wrap_period(a - b, PI).abs()
}

/// The mean of directions that are equal modulo a turn of 2π/k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KFoldMean {
    /// In [−π/k, π/k), radians.
    pub direction: f64,
    /// 1 when all directions agree modulo 2π/k, 0 when they cancel.
    pub strength: f64,
}

/// Weighted mean of (direction, weight) pairs modulo 2π/k: arg(Σ w exp(i k a)) / k.
///
/// `None` for no input, for weights that sum to zero, and when the directions cancel (strength
/// below 1e-6): then there is no mean. The order of the input changes nothing but rounding.
#[must_use]
pub fn mean_k_fold(
    weighted_directions: impl IntoIterator<Item = (f64, f64)>,
    k: u32,
) -> Option<KFoldMean> {
    let k = f64::from(k);
    let (mut cos_sum, mut sin_sum, mut weight_sum) = (0.0, 0.0, 0.0);
    for (direction, weight) in weighted_directions {
        let (sin, cos) = (k * direction).sin_cos();
        cos_sum += weight * cos;
        sin_sum += weight * sin;
        weight_sum += weight;
    }
    let strength = cos_sum.hypot(sin_sum) / weight_sum;
    // A NaN strength (no weight) fails this comparison too.
    if strength >= 1e-6 {
        let direction = wrap_period(sin_sum.atan2(cos_sum) / k, TAU / k);
        Some(KFoldMean { direction, strength })
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{mean_k_fold, undirected_difference, wrap_period};
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn wrap_matches_worked_examples() {
        for (value, period, expected) in
            [(190.0, 360.0, -170.0), (91.0, 90.0, 1.0), (45.0, 90.0, -45.0), (180.0, 360.0, -180.0)]
        {
            assert_eq!(wrap_period(value, period), expected, "wrap({value}, {period})");
        }
        let tiny = -180.0 - 1e-20;
        assert!(wrap_period(tiny, 360.0) < 180.0, "result must stay below half a period");
    }

    #[test]
    fn directions_on_both_sides_of_the_cut_are_close() {
        let difference = undirected_difference(89.9_f64.to_radians(), (-89.9_f64).to_radians());
        assert!((difference.to_degrees() - 0.2).abs() < 1e-9);

        let a = 89.5_f64.to_radians();
        let mean = mean_k_fold([(a, 1.0), (-a, 1.0)], 2).unwrap();
        assert!((mean.direction.to_degrees().abs() - 90.0).abs() < 1e-9);
    }

    #[test]
    fn there_is_no_mean_of_nothing_or_of_what_cancels() {
        assert_eq!(mean_k_fold([], 4), None);
        assert_eq!(mean_k_fold([(1.0, 0.0)], 4), None);
        assert_eq!(mean_k_fold([(0.0, 1.0), (std::f64::consts::FRAC_PI_2, 1.0)], 2), None);
    }

    proptest! {
        #[test]
        fn mean_ignores_order_and_symmetric_turns(
            items in prop::collection::vec((-0.1_f64..0.1, 0.1_f64..5.0, 0_u32..4), 1..20),
            offset in -3.0_f64..3.0,
        ) {
            let quarter = std::f64::consts::FRAC_PI_2;
            let plain = mean_k_fold(items.iter().map(|&(a, w, _)| (a + offset, w)), 4).unwrap();
            let turned = mean_k_fold(
                items.iter().rev().map(|&(a, w, q)| (a + offset + f64::from(q) * quarter, w)),
                4,
            ).unwrap();
            let difference = wrap_period(plain.direction - turned.direction, quarter);
            prop_assert!(difference.abs() < 1e-12, "{difference}");
        }
    }
}
