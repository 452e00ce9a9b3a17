//! How alike two places are displaced.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Point2, Vector2, Vector3};

use crate::params::WarpParams;

/// Square of the distance, in lengths of a scale, beyond which a covariance is below rounding.
const FAR: f64 = 81.0;

/// Covariance of each component of a displacement u, a sum of σ² exp(−r²/2ℓ²) over scales ℓ, and what
/// follows from it for the turn ω = ½ curl u: covariances of derivatives are derivatives of the
/// covariance (Rasmussen, Williams: *Gaussian Processes for Machine Learning*, Eq. 9.1).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernel {
    scales: [Scale; 2],
}

impl Kernel {
    pub(crate) fn new(params: &WarpParams) -> Self {
        let drift = Scale { sigma_m: params.drift_sigma_m, length_m: params.correlation_m };
        let detail = Scale { sigma_m: params.detail_sigma_m, length_m: params.detail_m };
        Self { scales: [drift, detail] }
    }

    /// Variance of each component, m².
    pub(crate) fn variance(&self) -> f64 {
        self.scales.iter().map(|scale| scale.sigma_m * scale.sigma_m).sum()
    }

    /// Covariance of u at `place` with (u, ω) at `at`.
    pub(crate) fn displacement(&self, place: Point2<f64>, at: Point2<f64>) -> Matrix2x3<f64> {
        self.scales.iter().map(|scale| scale.displacement(place, at)).sum()
    }

    /// Covariance of (u, ω) at `a` with (u, ω) at `b`.
    pub(crate) fn motion(&self, a: Point2<f64>, b: Point2<f64>) -> Matrix3<f64> {
        self.scales.iter().map(|scale| scale.motion(a, b)).sum()
    }

    /// The displacement at `place` by a motion at `at` of coefficients `by`.
    pub(crate) fn pull(
        &self,
        place: Point2<f64>,
        at: Point2<f64>,
        by: Vector3<f64>,
    ) -> Vector2<f64> {
        self.scales.iter().map(|scale| scale.pull(place, at, by)).sum()
    }

    /// The derivative of [`pull`](Self::pull) by the place.
    pub(crate) fn pull_gradient(
        &self,
        place: Point2<f64>,
        at: Point2<f64>,
        by: Vector3<f64>,
    ) -> Matrix2<f64> {
        self.scales.iter().map(|scale| scale.pull_gradient(place, at, by)).sum()
    }

    /// Most that a displacement of unit norm in the kernel's Hilbert space can change over a metre,
    /// anywhere and in any direction: its derivative along v is its product with ∂ᵥk, whose norm is
    /// the root of ∂ᵥ∂ᵥ'k at r = 0.
    pub(crate) fn steepest(&self) -> f64 {
        let slopes = self.scales.iter().map(|scale| (scale.sigma_m / scale.length_m).powi(2));
        slopes.sum::<f64>().sqrt()
    }

    /// Most that the slope of such a displacement can change over a metre, by the root of the fourth
    /// derivative of k at r = 0.
    pub(crate) fn most_curved(&self) -> f64 {
        let curvature = |scale: &Scale| scale.sigma_m / scale.length_m.powi(2);
        let squares = self.scales.iter().map(|scale| 3.0 * curvature(scale).powi(2));
        squares.sum::<f64>().sqrt()
    }
}

/// One term of the sum.
#[derive(Debug, Clone, Copy)]
struct Scale {
    sigma_m: f64,
    length_m: f64,
}

impl Scale {
    fn along(&self, away: Vector2<f64>) -> f64 {
        let scaled = away.norm_squared() / (self.length_m * self.length_m);
        if scaled > FAR { 0.0 } else { self.sigma_m * self.sigma_m * (-0.5 * scaled).exp() }
    }

    fn displacement(&self, place: Point2<f64>, at: Point2<f64>) -> Matrix2x3<f64> {
        let away = place - at;
        let k = self.along(away);
        let turned = quarter_turned(away) * (k * self.half_curvature());
        Matrix2x3::new(k, 0.0, turned.x, 0.0, k, turned.y)
    }

    fn motion(&self, a: Point2<f64>, b: Point2<f64>) -> Matrix3<f64> {
        let away = a - b;
        let k = self.along(away);
        let half = self.half_curvature();
        let turned = quarter_turned(away) * (k * half);
        let turn = k * half * (1.0 - half * away.norm_squared());
        Matrix3::new(
            k, 0.0, turned.x, //
            0.0, k, turned.y, //
            -turned.x, -turned.y, turn,
        )
    }

    fn pull(&self, place: Point2<f64>, at: Point2<f64>, by: Vector3<f64>) -> Vector2<f64> {
        let away = place - at;
        (by.xy() + quarter_turned(away) * (by.z * self.half_curvature())) * self.along(away)
    }

    fn pull_gradient(&self, place: Point2<f64>, at: Point2<f64>, by: Vector3<f64>) -> Matrix2<f64> {
        let away = place - at;
        let half = self.half_curvature();
        let direction = by.xy() + quarter_turned(away) * (by.z * half);
        let turn = Matrix2::new(0.0, -1.0, 1.0, 0.0) * (by.z * half);
        (turn - direction * away.transpose() * (2.0 * half)) * self.along(away)
    }

    /// 1/(2ℓ²).
    fn half_curvature(&self) -> f64 {
        0.5 / (self.length_m * self.length_m)
    }
}

fn quarter_turned(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}
