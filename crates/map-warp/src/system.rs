//! The linear system between what patches say and how drift displaces places.

use nalgebra::{DMatrix, DVector};
use ogm_core::Se2;

use crate::kernel::Kernel;
use crate::motion::Motion;

/// Prior covariance of all motions after the rigid one, noise, and what is left to do; three rows a
/// motion.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) prior: DMatrix<f64>,
    pub(crate) noise: DMatrix<f64>,
    pub(crate) left: DVector<f64>,
}

impl System {
    pub(crate) fn new(motions: &[Motion], kernel: &Kernel, straight_from_map: &Se2) -> Self {
        let size = 3 * motions.len();
        let (mut prior, mut noise) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        let mut left = DVector::zeros(size);
        for (i, a) in motions.iter().enumerate() {
            for (j, b) in motions.iter().enumerate() {
                prior.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&kernel.motion(a.at, b.at));
            }
            noise.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&a.noise(straight_from_map));
            left.fixed_rows_mut::<3>(3 * i).copy_from(&a.left_by(straight_from_map));
        }
        Self { prior, noise, left }
    }
}
