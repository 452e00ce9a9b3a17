//! Which patches lie: those that the others contradict.

use nalgebra::{Cholesky, DVector, Dyn, Matrix3, MatrixXx3, Vector3};
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
    let factor = (&system.prior + &system.noise).cholesky();
    let factor = factor.ok_or(WarpError::Singular { motions: motions.len() })?;
    let mut inverse = Inverse::new(&factor, &system.left);
    let mut kept = vec![true; motions.len()];
    loop {
        let worst = (0..motions.len())
            .filter(|&motion| kept[motion])
            .filter_map(|motion| {
                let pull = inverse.pull(motion);
                let covariance = inverse.blocks[motion].try_inverse()?;
                Some((motion, pull.dot(&(covariance * pull)), covariance))
            })
            .reduce(|worst, other| if other.1 > worst.1 { other } else { worst });
        let Some((motion, misfit, covariance)) = worst else { return Ok(kept) };
        if misfit <= sigmas * sigmas {
            return Ok(kept);
        }
        kept[motion] = false;
        inverse.leave_out(motion, covariance);
    }
}

/// What is asked of the inverse of a system, while motions are left out of it.
struct Inverse<'a> {
    factor: &'a Cholesky<f64, Dyn>,
    /// On its diagonal, one a motion.
    blocks: Vec<Matrix3<f64>>,
    /// Times what is left to do.
    pulls: DVector<f64>,
    /// Of each motion that was left out, its columns then and the inverse of its block.
    left_out: Vec<(MatrixXx3<f64>, Matrix3<f64>)>,
}

impl<'a> Inverse<'a> {
    fn new(factor: &'a Cholesky<f64, Dyn>, left: &DVector<f64>) -> Self {
        let (size, lower) = (left.len(), factor.l_dirty());
        // A⁻¹ = L⁻ᵀ L⁻¹, and the columns of L⁻¹ are zero above the diagonal.
        let block = |first: usize| {
            let rest = size - first;
            let mut columns = MatrixXx3::identity(rest);
            let below = lower.view((first, first), (rest, rest));
            below.solve_lower_triangular_mut(&mut columns);
            columns.tr_mul(&columns)
        };
        let blocks = (0..size).step_by(3).map(block).collect();
        Self { factor, blocks, pulls: factor.solve(left), left_out: Vec::new() }
    }

    fn pull(&self, motion: usize) -> Vector3<f64> {
        self.pulls.fixed_rows::<3>(3 * motion).into_owned()
    }

    /// The inverse without the rows and columns of a motion, zero there; `covariance` is the inverse
    /// of its block.
    fn leave_out(&mut self, motion: usize, covariance: Matrix3<f64>) {
        let mut columns = MatrixXx3::zeros(self.pulls.len());
        columns.fixed_rows_mut::<3>(3 * motion).fill_with_identity();
        self.factor.solve_mut(&mut columns);
        for (earlier, covariance) in &self.left_out {
            columns -= earlier * (covariance * rows(earlier, motion).transpose());
        }
        self.pulls -= &columns * (covariance * self.pull(motion));
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let rows = rows(&columns, index);
            *block -= rows * covariance * rows.transpose();
        }
        self.left_out.push((columns, covariance));
    }
}

fn rows(columns: &MatrixXx3<f64>, motion: usize) -> Matrix3<f64> {
    columns.fixed_rows::<3>(3 * motion).into_owned()
}

#[cfg(test)]
mod tests {
    use super::Inverse;
    use nalgebra::{DMatrix, DVector, Matrix3};
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        #[test]
        fn leaving_motions_out_is_the_inverse_of_the_system_without_them(
            numbers in prop::collection::vec(-1.0_f64..1.0, 18 * 18 + 18),
            first in 0_usize..6, second in 0_usize..5,
        ) {
            let second = if second >= first { second + 1 } else { second };
            let mixed = DMatrix::from_column_slice(18, 18, &numbers[..18 * 18]);
            let system = &mixed * mixed.transpose() + DMatrix::identity(18, 18);
            let left = DVector::from_column_slice(&numbers[18 * 18..]);
            let factor = system.clone().cholesky().unwrap();
            let mut inverse = Inverse::new(&factor, &left);
            for motion in [first, second] {
                let covariance = inverse.blocks[motion].try_inverse().unwrap();
                inverse.leave_out(motion, covariance);
            }
            let kept: Vec<usize> = (0..6).filter(|&i| i != first && i != second).collect();
            let rows: Vec<usize> = kept.iter().flat_map(|&i| 3 * i..3 * i + 3).collect();
            let without = system.select_rows(&rows).select_columns(&rows).try_inverse().unwrap();
            let pulls = &without * left.select_rows(&rows);
            for (place, &motion) in kept.iter().enumerate() {
                let block: Matrix3<f64> = without.fixed_view::<3, 3>(3 * place, 3 * place).into();
                prop_assert!((inverse.blocks[motion] - block).amax() < 1e-9);
                let pull = pulls.fixed_rows::<3>(3 * place);
                prop_assert!((inverse.pull(motion) - pull).amax() < 1e-9);
            }
        }
    }
}
