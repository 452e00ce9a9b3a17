//! How alike two places are displaced.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Point2, Vector2, Vector3};

/// Covariance σ² exp(−r²/2ℓ²) of each component of a displacement u, and what follows from it for
/// the turn ω = ½ curl u: covariances of derivatives are derivatives of the covariance (Rasmussen,
/// Williams: *Gaussian Processes for Machine Learning*, Eq. 9.1).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernel {
    pub(crate) sigma_m: f64,
    pub(crate) length_m: f64,
}

impl Kernel {
    fn along(&self, away: Vector2<f64>) -> f64 {
        let scaled = away.norm_squared() / (self.length_m * self.length_m);
        self.sigma_m * self.sigma_m * (-0.5 * scaled).exp()
    }

    /// Covariance of u at `place` with (u, ω) at `at`.
    pub(crate) fn displacement(&self, place: Point2<f64>, at: Point2<f64>) -> Matrix2x3<f64> {
        let away = place - at;
        let k = self.along(away);
        let turned = quarter_turned(away) * (k * self.half_curvature());
        Matrix2x3::new(k, 0.0, turned.x, 0.0, k, turned.y)
    }

    /// Covariance of (u, ω) at `a` with (u, ω) at `b`.
    pub(crate) fn motion(&self, a: Point2<f64>, b: Point2<f64>) -> Matrix3<f64> {
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

    /// The displacement at `place` by a motion at `at` of coefficients `by`.
    pub(crate) fn pull(
        &self,
        place: Point2<f64>,
        at: Point2<f64>,
        by: Vector3<f64>,
    ) -> Vector2<f64> {
        let away = place - at;
        (by.xy() + quarter_turned(away) * (by.z * self.half_curvature())) * self.along(away)
    }

    /// The derivative of [`pull`](Self::pull) by the place.
    pub(crate) fn pull_gradient(
        &self,
        place: Point2<f64>,
        at: Point2<f64>,
        by: Vector3<f64>,
    ) -> Matrix2<f64> {
        let away = place - at;
        let half = self.half_curvature();
        let direction = by.xy() + quarter_turned(away) * (by.z * half);
        let turn = Matrix2::new(0.0, -1.0, 1.0, 0.0) * (by.z * half);
        (turn - direction * away.transpose() * (2.0 * half)) * self.along(away)
    }

    /// Most that a displacement of unit norm in the kernel's Hilbert space can change over a metre,
    /// anywhere and in any direction: its derivative along v is its product with ∂ᵥk, whose norm is
    /// the root of ∂ᵥ∂ᵥ'k at r = 0.
    pub(crate) fn steepest(&self) -> f64 {
        self.sigma_m / self.length_m
    }

    /// 1/(2ℓ²).
    fn half_curvature(&self) -> f64 {
        0.5 / (self.length_m * self.length_m)
    }
}

fn quarter_turned(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}
