//! How one patch of a map must move.

use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::{Se2, wrap_angle};

use crate::error::WarpError;

/// Coordinates beyond this many metres leave no precision for a bend.
const FARTHEST_M: f64 = 1e7;

/// Least standard deviations of a measured motion, metres and radians: half a cell of a fine map,
/// and what that is over five metres. They keep the system well conditioned.
const FLOOR: [f64; 3] = [0.01, 0.01, 0.002];

/// How a patch of a map, about the size of a room, must move to lie where it belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// The middle of the patch, in the map, metres.
    pub at: Point2<f64>,
    /// How far that place must move, along the axes of the map, metres.
    pub shift: Vector2<f64>,
    /// How far the patch must turn about that place, radians, counter-clockwise.
    pub turn: f64,
    /// Of (`shift`, `turn`), in m², m·rad and rad².
    pub covariance: Matrix3<f64>,
}

impl Motion {
    /// The motion of the whole map that moves it as this patch moves.
    pub(crate) fn straight_from_map(&self) -> Se2 {
        Se2::about(self.at, self.turn, self.shift)
    }

    /// What is left to do in the patch after `straight_from_map` has moved the map: shift along the
    /// axes of the map before that motion, and turn.
    pub(crate) fn left_by(&self, straight_from_map: &Se2) -> Vector3<f64> {
        let shift = straight_from_map.inverse() * (self.at + self.shift) - self.at;
        Vector3::new(shift.x, shift.y, wrap_angle(self.turn - straight_from_map.theta()))
    }

    /// The covariance of [`left_by`](Self::left_by), with its floor.
    pub(crate) fn noise(&self, straight_from_map: &Se2) -> Matrix3<f64> {
        let (sin, cos) = straight_from_map.theta().sin_cos();
        let back = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
        let floor = Matrix3::from_diagonal(&Vector3::from(FLOOR.map(|sigma| sigma * sigma)));
        back * self.covariance * back.transpose() + floor
    }

    pub(crate) fn check(&self, motion: usize) -> Result<(), WarpError> {
        let numbers = [self.at.coords.as_slice(), self.shift.as_slice(), &[self.turn]];
        let finite = numbers.iter().copied().flatten().all(|number| number.is_finite());
        if !finite || self.covariance.iter().any(|number| !number.is_finite()) {
            return Err(WarpError::NonFinite { motion });
        }
        let reach_m = self.at.coords.amax().max(self.shift.amax());
        if reach_m > FARTHEST_M {
            return Err(WarpError::TooFar { motion, reach_m, limit_m: FARTHEST_M });
        }
        let size = self.covariance.amax();
        let least = if (self.covariance - self.covariance.transpose()).amax() > 1e-9 * size {
            f64::NAN
        } else {
            self.covariance.symmetric_eigenvalues().min()
        };
        if least >= -1e-9 * size { Ok(()) } else { Err(WarpError::BadCovariance { motion, least }) }
    }
}
