//! Sparse Cholesky factors, by `faer`.

use faer::Conj;
use faer::MatMut;
use faer::Side;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use nalgebra::DMatrix;

use crate::error::GraphError;

/// A pattern with its ordering and that of its factor.
#[derive(Debug)]
pub(crate) struct Pattern {
    matrix: SymbolicSparseColMat<usize>,
    factor: SymbolicLlt<usize>,
}

impl Pattern {
    pub(crate) fn new(
        order: usize,
        column_starts: &[usize],
        rows: &[usize],
    ) -> Result<Self, GraphError> {
        let (starts, rows) = (column_starts.to_vec(), rows.to_vec());
        let matrix = SymbolicSparseColMat::new_checked(order, order, starts, None, rows);
        // It fails for lack of memory only.
        let factor = SymbolicLlt::try_new(matrix.as_ref(), Side::Lower);
        Ok(Self { factor: factor.map_err(|_error| GraphError::Singular)?, matrix })
    }

    pub(crate) fn factorise(&self, values: &[f64]) -> Option<SparseFactor> {
        let matrix = SparseColMatRef::new(self.matrix.as_ref(), values);
        Llt::try_new_with_symbolic(self.factor.clone(), matrix, Side::Lower).ok().map(SparseFactor)
    }
}

/// A sparse factor.
#[derive(Debug)]
pub(crate) struct SparseFactor(Llt<usize, f64>);

impl SparseFactor {
    pub(crate) fn solve(&self, right: &mut DMatrix<f64>) {
        let (rows, columns) = right.shape();
        let right = MatMut::from_column_major_slice_mut(right.as_mut_slice(), rows, columns);
        self.0.solve_in_place_with_conj(Conj::No, right);
    }
}
