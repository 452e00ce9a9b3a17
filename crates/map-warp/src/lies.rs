//! Which patches lie: those that the others contradict.

use nalgebra::{DMatrix, Matrix3};
use ogm_core::Se2;

use crate::error::WarpError;
use crate::kernel::Kernel;
use crate::motion::Motion;
use crate::system::System;

/// Which motions the others bear out: the worst contradicted is left out, and all are judged again,
/// until none is more than `sigmas` standard deviations from what the others predict. Predictions
/// without a motion come from the inverse of the system with it (Rasmussen, Williams, Eqs. 5.10–5.12).
pub(crate) fn borne_out(
    motions: &[Motion],
    kernel: &Kernel,
    straight_from_map: &Se2,
    sigmas: f64,
) -> Result<Vec<bool>, WarpError> {
    let system = System::new(motions, kernel, straight_from_map);
    let inverse = (&system.prior + &system.noise).cholesky().map(|factor| factor.inverse());
    let mut inverse = inverse.ok_or(WarpError::Singular { motions: motions.len() })?;
    let mut kept = vec![true; motions.len()];
    loop {
        let pull = &inverse * &system.left;
        let worst = (0..motions.len())
            .filter(|&motion| kept[motion])
            .filter_map(|motion| {
                let pull = pull.fixed_rows::<3>(3 * motion).into_owned();
                let covariance = block(&inverse, motion).try_inverse()?;
                Some((motion, pull.dot(&(covariance * pull)), covariance))
            })
            .reduce(|worst, other| if other.1 > worst.1 { other } else { worst });
        let Some((motion, misfit, covariance)) = worst else { return Ok(kept) };
        if misfit <= sigmas * sigmas {
            return Ok(kept);
        }
        kept[motion] = false;
        let columns = inverse.fixed_columns::<3>(3 * motion).into_owned();
        inverse -= &columns * covariance * columns.transpose();
        inverse.fixed_columns_mut::<3>(3 * motion).fill(0.0);
        inverse.fixed_rows_mut::<3>(3 * motion).fill(0.0);
    }
}

fn block(matrix: &DMatrix<f64>, motion: usize) -> Matrix3<f64> {
    matrix.fixed_view::<3, 3>(3 * motion, 3 * motion).into_owned()
}
