//! The deformation: where every place of a map goes, and back.

use nalgebra::{Cholesky, DMatrix, Dyn, Matrix2, Point2, Vector2, Vector3};
use ogm_core::Se2;

use crate::error::WarpError;
use crate::kernel::Kernel;
use crate::lies::borne_out;
use crate::motion::Motion;
use crate::params::WarpParams;
use crate::rigid::{Belief, rigid_motion};
use crate::system::System;

/// More motions would take seconds: the system is dense.
const MOST_MOTIONS: usize = 500;

/// Most that the displacement may change over a metre, anywhere. Below 1 no two places come to lie
/// on one; at this, no length shrinks below a fifth.
const STEEPEST: f64 = 0.8;

/// Steps that bring any start to rounding: each leaves at most [`STEEPEST`] of the error.
const INVERSE_STEPS: usize = 200;

/// A smooth deformation of a map without folds, and how sure it is.
///
/// Points go from the frame of the map to the straightened one, in which the patches lie where
/// their motions put them: p ↦ M (p + d(p)), with the rigid motion M of the whole map and the
/// displacement d that drift left.
#[derive(Debug, Clone)]
pub struct Warp {
    straight_from_map: Se2,
    kernel: Kernel,
    /// Places of the motions that are believed, and their coefficients.
    centres: Vec<(Point2<f64>, Vector3<f64>)>,
    factor: Option<Cholesky<f64, Dyn>>,
    believed: Vec<bool>,
    steepness: f64,
    stiffened: f64,
}

impl Warp {
    /// The deformation that is likeliest to have undone the drift, given `motions` of patches. It is
    /// the identity if there are none.
    ///
    /// Motions that the others contradict are left out; [`believed`](Self::believed) says which.
    ///
    /// # Errors
    /// If a number is not finite, a covariance is none, a parameter is outside its range, or there
    /// are more than 500 motions.
    pub fn fit(motions: &[Motion], params: &WarpParams) -> Result<Self, WarpError> {
        params.check()?;
        if motions.len() > MOST_MOTIONS {
            return Err(WarpError::TooManyMotions { have: motions.len(), limit: MOST_MOTIONS });
        }
        for (index, motion) in motions.iter().enumerate() {
            motion.check(index)?;
        }
        let kernel = Kernel::new(params);
        let rough_straight_from_map = rigid_motion(motions, &kernel, Belief::Doubting);
        let believed =
            borne_out(motions, &kernel, &rough_straight_from_map, params.outlier_sigmas)?;
        let kept: Vec<Motion> =
            motions.iter().zip(&believed).filter(|(_, kept)| **kept).map(|(m, _)| *m).collect();
        let straight_from_map = rigid_motion(&kept, &kernel, Belief::Full);
        let mut warp = Self {
            straight_from_map,
            kernel,
            centres: Vec::new(),
            factor: None,
            believed,
            steepness: 0.0,
            stiffened: 1.0,
        };
        if !kept.is_empty() {
            warp.bend(&kept)?;
        }
        Ok(warp)
    }

    /// The best fit among the displacements that cannot fold. Of all displacements with a norm below
    /// a bound, the best fit is the one for some larger noise, so the noise grows until the bound
    /// holds.
    fn bend(&mut self, kept: &[Motion]) -> Result<(), WarpError> {
        let system = System::new(kept, &self.kernel, &self.straight_from_map);
        loop {
            let both = &system.prior + &system.noise * self.stiffened;
            let factor = both.cholesky().ok_or(WarpError::Singular { motions: kept.len() })?;
            let coefficients = factor.solve(&system.left);
            let norm_squared = coefficients.dot(&(&system.prior * &coefficients));
            self.steepness = self.kernel.steepest() * norm_squared.max(0.0).sqrt();
            if self.steepness <= STEEPEST {
                let by = |i: usize| coefficients.fixed_rows::<3>(3 * i).into_owned();
                self.centres = kept.iter().enumerate().map(|(i, m)| (m.at, by(i))).collect();
                self.factor = Some(factor);
                return Ok(());
            }
            self.stiffened *= 1.5;
        }
    }

    /// Where a place of the map lies in the straightened frame.
    #[must_use]
    pub fn apply(&self, place: Point2<f64>) -> Point2<f64> {
        self.straight_from_map * (place + self.displacement(place))
    }

    /// The place of the map that lies at a place of the straightened frame; exact to rounding.
    ///
    /// A Newton step is taken where it does better than p ← q − d(p), which contracts.
    #[must_use]
    pub fn inverse(&self, straight: Point2<f64>) -> Point2<f64> {
        let goal = self.straight_from_map.inverse() * straight;
        self.undisplaced(goal, goal)
    }

    /// The place from which the displacement leads to `goal`, from a start.
    fn undisplaced(&self, goal: Point2<f64>, start: Point2<f64>) -> Point2<f64> {
        let missing = |place: Point2<f64>| goal - place - self.displacement(place);
        let enough = f64::EPSILON * (1.0 + goal.coords.amax());
        let (mut place, mut error) = (start, missing(start));
        for _ in 0..INVERSE_STEPS {
            if error.amax() <= enough {
                break;
            }
            let newton = (Matrix2::identity() + self.gradient(place)).try_inverse();
            let step = newton.map_or(error, |inverse| inverse * error);
            let there = missing(place + step);
            if there.norm() <= STEEPEST * error.norm() {
                (place, error) = (place + step, there);
            } else {
                let there = missing(place + error);
                if there.norm() >= error.norm() {
                    break;
                }
                (place, error) = (place + error, there);
            }
        }
        place
    }

    /// The derivative of [`apply`](Self::apply), without a unit. Its determinant is above zero
    /// everywhere.
    #[must_use]
    pub fn jacobian(&self, place: Point2<f64>) -> Matrix2<f64> {
        let (sin, cos) = self.straight_from_map.theta().sin_cos();
        Matrix2::new(cos, -sin, sin, cos) * (Matrix2::identity() + self.gradient(place))
    }

    /// Covariance of where a place of the map lies, given the rigid part, along the axes of the
    /// straightened frame, m²: that of drift far from all motions.
    #[must_use]
    pub fn covariance(&self, place: Point2<f64>) -> Matrix2<f64> {
        let prior = Matrix2::from_diagonal_element(self.kernel.variance());
        let Some(factor) = &self.factor else { return prior };
        let mut seen = DMatrix::zeros(3 * self.centres.len(), 2);
        for (i, (at, _)) in self.centres.iter().enumerate() {
            let with = self.kernel.displacement(place, *at);
            seen.fixed_rows_mut::<3>(3 * i).copy_from(&with.transpose());
        }
        let known = seen.transpose() * factor.solve(&seen);
        let left = prior - known.fixed_view::<2, 2>(0, 0);
        let (sin, cos) = self.straight_from_map.theta().sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        turn * left * turn.transpose()
    }

    /// Standard deviation of where a place of the map lies, in the direction in which it is least
    /// sure, metres; see [`covariance`](Self::covariance).
    #[must_use]
    pub fn sigma(&self, place: Point2<f64>) -> f64 {
        self.covariance(place).symmetric_eigenvalues().max().max(0.0).sqrt()
    }

    /// The motion of the map as one piece.
    #[must_use]
    pub fn straight_from_map(&self) -> Se2 {
        self.straight_from_map
    }

    /// How far a place moves beyond the rigid part, along the axes of the map, metres.
    #[must_use]
    pub fn displacement(&self, place: Point2<f64>) -> Vector2<f64> {
        self.centres.iter().map(|&(at, by)| self.kernel.pull(place, at, by)).sum()
    }

    /// Which of the motions the others bear out, in the order in which they were given.
    #[must_use]
    pub fn believed(&self) -> &[bool] {
        &self.believed
    }

    /// A bound on how much the displacement changes over a metre, anywhere; at most 0.8.
    #[must_use]
    pub fn steepness(&self) -> f64 {
        self.steepness
    }

    /// By how much the variances of the motions were enlarged so that nothing folds; 1 if not at
    /// all.
    #[must_use]
    pub fn stiffened(&self) -> f64 {
        self.stiffened
    }

    /// A bound on how much the slope of the displacement changes over a metre, anywhere.
    pub(crate) fn curvature(&self) -> f64 {
        self.kernel.most_curved() * self.steepness / self.kernel.steepest()
    }

    fn gradient(&self, place: Point2<f64>) -> Matrix2<f64> {
        self.centres.iter().map(|&(at, by)| self.kernel.pull_gradient(place, at, by)).sum()
    }
}
