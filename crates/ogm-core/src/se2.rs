//! Rigid motions of the plane.

use std::fmt;
use std::ops::Mul;

use nalgebra::{Complex, Isometry2, Point2, Translation2, UnitComplex, Vector2, Vector3};

use crate::GridError;
use crate::angle::wrap_angle;

/// A rigid motion of the plane: rotate by θ, then translate by (x, y).
///
/// Counter-clockwise is positive. It maps points, and every name of one says both frames:
/// `p_target = target_from_source * p_source`. Motions compose with `*`, so frames cancel in
/// reading order: `a_from_c = a_from_b * b_from_c`.
///
/// The exponential map and its inverse are those of Solà, Deray, Atchuthan: *A micro Lie theory*,
/// Eqs. 156–158, on the tangent vector (x, y, θ).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Se2(Isometry2<f64>);

/// Below this angle the series of sin θ/θ and (1 − cos θ)/θ are exact to rounding.
const SMALL_ANGLE: f64 = 1e-4;

impl Se2 {
    /// The motion that rotates by `theta` radians and then translates by (`x`, `y`) metres.
    #[must_use]
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        Self(Isometry2::new(Vector2::new(x, y), theta))
    }

    /// The motion that leaves every point where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self(Isometry2::identity())
    }

    /// The motion of these `parts`: x and y in metres, cosine and sine of the rotation. With
    /// [`parts`](Self::parts) it is written down and read again to the last bit; `None` for numbers
    /// that are not finite or no rotation.
    #[must_use]
    pub fn from_parts([x, y, cos, sin]: [f64; 4]) -> Option<Self> {
        let is_rotation = (cos.hypot(sin) - 1.0).abs() < 1e-9;
        (x.is_finite() && y.is_finite() && is_rotation).then(|| {
            let rotation = UnitComplex::new_unchecked(Complex::new(cos, sin));
            Self(Isometry2::from_parts(Translation2::new(x, y), rotation))
        })
    }

    /// x and y in metres, cosine and sine of the rotation.
    #[must_use]
    pub fn parts(&self) -> [f64; 4] {
        [self.x(), self.y(), self.0.rotation.re, self.0.rotation.im]
    }

    /// Rotation by `theta` radians about `centre`, then translation.
    #[must_use]
    pub fn about(centre: Point2<f64>, theta: f64, translation: Vector2<f64>) -> Self {
        let rotated = Isometry2::rotation(theta) * centre;
        let offset = centre - rotated + translation;
        Self::new(offset.x, offset.y, theta)
    }

    /// Translation along x, metres.
    #[must_use]
    pub fn x(&self) -> f64 {
        self.0.translation.x
    }

    /// Translation along y, metres.
    #[must_use]
    pub fn y(&self) -> f64 {
        self.0.translation.y
    }

    /// Rotation in [−π, π), radians.
    #[must_use]
    pub fn theta(&self) -> f64 {
        wrap_angle(self.0.rotation.angle())
    }

    /// The translation that follows the rotation, metres.
    #[must_use]
    pub fn translation(&self) -> Vector2<f64> {
        self.0.translation.vector
    }

    /// `source_from_target` of a `target_from_source`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }

    /// `self_from_other`: the motion that maps the frame of `other` into that of `self`, both
    /// given in one common frame.
    #[must_use]
    pub fn between(&self, other: &Self) -> Self {
        self.inverse() * *other
    }

    /// The motion reached by the constant twist (x, y, θ) in unit time.
    #[must_use]
    pub fn exp(twist: Vector3<f64>) -> Self {
        let (sin_over, cos_over) = half_turn_factors(twist.z);
        let x = sin_over * twist.x - cos_over * twist.y;
        let y = cos_over * twist.x + sin_over * twist.y;
        Self::new(x, y, twist.z)
    }

    /// The twist (x, y, θ), |θ| ≤ π, whose [`exp`](Self::exp) is this motion.
    #[must_use]
    pub fn log(&self) -> Vector3<f64> {
        let theta = self.theta();
        let (sin_over, cos_over) = half_turn_factors(theta);
        let scale = 1.0 / (sin_over * sin_over + cos_over * cos_over);
        let (x, y) = (self.x(), self.y());
        Vector3::new(
            scale * (sin_over * x + cos_over * y),
            scale * (sin_over * y - cos_over * x),
            theta,
        )
    }

    /// That x, y and θ are all finite, for transforms that come from outside.
    ///
    /// # Errors
    /// [`GridError::NonFiniteTransform`].
    pub fn check_finite(&self) -> Result<(), GridError> {
        if self.is_finite() {
            return Ok(());
        }
        Err(GridError::NonFiniteTransform { x: self.x(), y: self.y(), theta: self.theta() })
    }

    /// Whether x, y and θ are all finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.x().is_finite() && self.y().is_finite() && self.theta().is_finite()
    }
}

/// sin θ/θ and (1 − cos θ)/θ.
fn half_turn_factors(theta: f64) -> (f64, f64) {
    if theta.abs() < SMALL_ANGLE {
        (1.0 - theta * theta / 6.0, theta / 2.0)
    } else {
        (theta.sin() / theta, (1.0 - theta.cos()) / theta)
    }
}

/// To the millimetre and the hundredth of a degree, `x 1.250 m, y -0.300 m, theta 90.00 deg`;
/// another precision, as in `{:.6}`, is that of the metres and one digit less of the degrees.
impl fmt::Display for Se2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(3);
        let angle_digits = digits.saturating_sub(1);
        let [x, y] = [self.x(), self.y()].map(|metres| unsigned_zero(metres, digits));
        let theta = unsigned_zero(self.theta().to_degrees(), angle_digits);
        write!(f, "x {x:.digits$} m, y {y:.digits$} m, theta {theta:.angle_digits$} deg")
    }
}

/// Zero where `value` prints as a negative zero with this many digits.
fn unsigned_zero(value: f64, digits: usize) -> f64 {
    let half = 0.5 * 10_f64.powi(-i32::try_from(digits).unwrap_or(i32::MAX));
    if value.abs() < half { 0.0 } else { value }
}

impl Mul for Se2 {
    type Output = Self;

    #[inline]
    fn mul(self, right: Self) -> Self {
        Self(self.0 * right.0)
    }
}

impl Mul<Point2<f64>> for Se2 {
    type Output = Point2<f64>;

    #[inline]
    fn mul(self, point: Point2<f64>) -> Point2<f64> {
        self.0 * point
    }
}

/// Vectors rotate and do not translate.
impl Mul<Vector2<f64>> for Se2 {
    type Output = Vector2<f64>;

    #[inline]
    fn mul(self, vector: Vector2<f64>) -> Vector2<f64> {
        self.0 * vector
    }
}

impl From<Isometry2<f64>> for Se2 {
    fn from(isometry: Isometry2<f64>) -> Self {
        Self(isometry)
    }
}

impl From<Se2> for Isometry2<f64> {
    fn from(motion: Se2) -> Self {
        motion.0
    }
}

#[cfg(test)]
mod tests {
    use super::{SMALL_ANGLE, Se2};
    use nalgebra::{Isometry2, Point2, Vector2, Vector3};
    use proptest::prelude::{Strategy, prop_assert, proptest};
    use std::f64::consts::PI;

    fn motion() -> impl Strategy<Value = Se2> {
        (-100.0_f64..100.0, -100.0_f64..100.0, -PI..PI).prop_map(|(x, y, t)| Se2::new(x, y, t))
    }

    fn distance(a: Se2, b: Se2) -> f64 {
        let probe = Point2::new(3.0, -2.0);
        (a * probe - b * probe).norm() + (a.translation() - b.translation()).norm()
    }

    proptest! {
        #[test]
        fn composition_is_associative(a in motion(), b in motion(), c in motion()) {
            prop_assert!(distance((a * b) * c, a * (b * c)) < 1e-9);
        }

        #[test]
        fn inverse_undoes_and_identity_is_neutral(a in motion()) {
            prop_assert!(distance(a * a.inverse(), Se2::identity()) < 1e-10);
            prop_assert!(distance(a.inverse() * a, Se2::identity()) < 1e-10);
            prop_assert!(distance(a * Se2::identity(), a) < 1e-12);
        }

        #[test]
        fn composition_applies_right_first(a in motion(), b in motion(), x in -9.0_f64..9.0) {
            let p = Point2::new(x, 1.0 - x);
            prop_assert!(((a * b) * p - a * (b * p)).norm() < 1e-10);
        }

        #[test]
        fn what_is_written_down_is_read_to_the_last_bit(a in motion(), b in motion()) {
            let product = a * b;
            prop_assert!(Se2::from_parts(product.parts()) == Some(product));
            let [x, y, cos, sin] = product.parts();
            prop_assert!(Se2::from_parts([x, y, cos + 0.1, sin]).is_none());
            prop_assert!(Se2::from_parts([f64::NAN, y, cos, sin]).is_none());
        }

        #[test]
        fn exp_inverts_log(a in motion()) {
            prop_assert!(distance(Se2::exp(a.log()), a) < 1e-9);
        }

        #[test]
        fn exp_of_a_sum_of_parallel_twists_composes(
            x in -5.0_f64..5.0, y in -5.0_f64..5.0, t in -1.0_f64..1.0, s in 0.0_f64..1.0,
        ) {
            let twist = Vector3::new(x, y, t);
            let composed = Se2::exp(twist * s) * Se2::exp(twist * (1.0 - s));
            prop_assert!(distance(composed, Se2::exp(twist)) < 1e-10);
        }

        #[test]
        fn between_is_the_relative_motion(a in motion(), b in motion()) {
            prop_assert!(distance(a * a.between(&b), b) < 1e-9);
        }

        #[test]
        fn nalgebra_round_trip_is_exact(a in motion()) {
            prop_assert!(Se2::from(Isometry2::from(a)) == a);
        }
    }

    #[test]
    fn exp_is_continuous_where_the_series_takes_over() {
        for angle in [SMALL_ANGLE * 0.999_999_9, -SMALL_ANGLE * 0.999_999_9] {
            let series = Se2::exp(Vector3::new(2.0, -1.0, angle));
            let closed = Se2::exp(Vector3::new(2.0, -1.0, angle * 1.000_000_2));
            assert!(distance(series, closed) < 5e-10, "jump at {angle}");
        }
    }

    #[test]
    fn it_prints_metres_and_degrees_and_no_negative_zero() {
        let pose = Se2::new(1.25, -0.0004, PI / 2.0);
        assert_eq!(pose.to_string(), "x 1.250 m, y 0.000 m, theta 90.00 deg");
        assert_eq!(format!("{pose:.4}"), "x 1.2500 m, y -0.0004 m, theta 90.000 deg");
    }

    #[test]
    fn half_a_turn_reads_minus_pi() {
        assert_eq!(Se2::new(0.0, 0.0, PI).theta(), -PI);
        assert_eq!(Se2::new(0.0, 0.0, -PI).theta(), -PI);
    }

    #[test]
    fn rotation_about_a_centre_keeps_the_centre() {
        let centre = Point2::new(4.0, -7.0);
        let turned = Se2::about(centre, 1.1, Vector2::zeros()) * centre;
        assert!((turned - centre).norm() < 1e-12);
    }
}
