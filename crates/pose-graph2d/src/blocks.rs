//! Symmetric matrices of small blocks, of which most are zero.

use nalgebra::{DMatrix, SMatrix, SVector};

use crate::error::GraphError;

/// The lower triangle, column after column, of a symmetric matrix of `B` × `B` blocks.
#[derive(Debug)]
pub(crate) struct BlockMatrix<const B: usize> {
    /// Block rows below the diagonal in every block column, ascending.
    below: Vec<Vec<usize>>,
    pub(crate) column_starts: Vec<usize>,
    pub(crate) rows: Vec<usize>,
    pub(crate) values: Vec<f64>,
}

impl<const B: usize> BlockMatrix<B> {
    /// Zeros, with room for the blocks on the diagonal and at `pairs`.
    pub(crate) fn new(blocks: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut below = vec![Vec::new(); blocks];
        for (a, b) in pairs {
            below[a.min(b)].push(a.max(b));
        }
        let (mut column_starts, mut rows) = (vec![0], Vec::new());
        for (block, below) in below.iter_mut().enumerate() {
            below.sort_unstable();
            below.dedup();
            for column in 0..B {
                rows.extend((column..B).map(|row| block * B + row));
                for &other in below.iter() {
                    rows.extend((0..B).map(|row| other * B + row));
                }
                column_starts.push(rows.len());
            }
        }
        let values = vec![0.0; rows.len()];
        Self { below, column_starts, rows, values }
    }

    /// Rows.
    pub(crate) fn order(&self) -> usize {
        self.below.len() * B
    }

    pub(crate) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    pub(crate) fn add_diagonal(&mut self, block: usize, value: &SMatrix<f64, B, B>) {
        for column in 0..B {
            let start = self.column_starts[block * B + column];
            for row in column..B {
                self.values[start + row - column] += value[(row, column)];
            }
        }
    }

    /// Adds `value` in block row `row` and block column `column`, and its transpose across the
    /// diagonal.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: &SMatrix<f64, B, B>) {
        let is_below = row > column;
        let (high, low) = if is_below { (row, column) } else { (column, row) };
        let Ok(place) = self.below[low].binary_search(&high) else { return };
        for c in 0..B {
            let start = self.column_starts[low * B + c] + (B - c) + place * B;
            for r in 0..B {
                self.values[start + r] += if is_below { value[(r, c)] } else { value[(c, r)] };
            }
        }
    }

    /// Values on the diagonal grow by `share` of themselves.
    pub(crate) fn damped(&self, share: f64) -> Vec<f64> {
        let mut values = self.values.clone();
        for &start in &self.column_starts[..self.order()] {
            values[start] *= 1.0 + share;
        }
        values
    }

    fn dense(&self, values: &[f64]) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.order(), self.order());
        for column in 0..self.order() {
            for at in self.column_starts[column]..self.column_starts[column + 1] {
                dense[(self.rows[at], column)] = values[at];
            }
        }
        dense
    }
}

/// Most rows that are factorised as a dense matrix where there is a choice: about where the sparse
/// one becomes faster.
#[cfg(feature = "faer")]
const MOST_DENSE: usize = 150;
/// Most rows without the sparse one: a few seconds a step.
#[cfg(not(feature = "faer"))]
const MOST_DENSE: usize = 3000;

/// What is computed once of a pattern.
#[derive(Debug)]
pub(crate) enum Solver {
    Dense,
    #[cfg(feature = "faer")]
    Sparse(crate::sparse::Pattern),
}

impl Solver {
    pub(crate) fn new<const B: usize>(matrix: &BlockMatrix<B>) -> Result<Self, GraphError> {
        if matrix.order() <= MOST_DENSE {
            return Ok(Self::Dense);
        }
        #[cfg(feature = "faer")]
        {
            crate::sparse::Pattern::new(matrix.order(), &matrix.column_starts, &matrix.rows)
                .map(Self::Sparse)
        }
        #[cfg(not(feature = "faer"))]
        Err(GraphError::TooLarge { nodes: matrix.order() / B + 1, most: MOST_DENSE / B + 1 })
    }

    /// `None` where `values` are not those of a positive definite matrix.
    pub(crate) fn factorise<const B: usize>(
        &self,
        matrix: &BlockMatrix<B>,
        values: &[f64],
    ) -> Option<Factor> {
        match self {
            Self::Dense => matrix.dense(values).cholesky().map(Factor::Dense),
            #[cfg(feature = "faer")]
            Self::Sparse(pattern) => pattern.factorise(values).map(Factor::Sparse),
        }
    }
}

/// A factorised matrix.
#[derive(Debug)]
pub(crate) enum Factor {
    Dense(nalgebra::Cholesky<f64, nalgebra::Dyn>),
    #[cfg(feature = "faer")]
    Sparse(crate::sparse::SparseFactor),
}

impl Factor {
    /// Solves for every column of `right` in place.
    pub(crate) fn solve(&self, right: &mut DMatrix<f64>) {
        match self {
            Self::Dense(factor) => factor.solve_mut(right),
            #[cfg(feature = "faer")]
            Self::Sparse(factor) => factor.solve(right),
        }
    }

    /// The blocks on the diagonal of the inverse.
    pub(crate) fn inverse_blocks<const B: usize>(&self, order: usize) -> Vec<SMatrix<f64, B, B>> {
        let blocks = order / B;
        let at_once = (MOST_DENSE / B).max(1);
        let mut found = Vec::with_capacity(blocks);
        for first in (0..blocks).step_by(at_once) {
            let last = (first + at_once).min(blocks);
            let mut unit = DMatrix::zeros(order, (last - first) * B);
            for column in 0..unit.ncols() {
                unit[(first * B + column, column)] = 1.0;
            }
            self.solve(&mut unit);
            found.extend((first..last).map(|block| {
                SMatrix::from_fn(|row, column| {
                    unit[(block * B + row, (block - first) * B + column)]
                })
            }));
        }
        found
    }
}

/// `vector` by blocks.
pub(crate) fn block<const B: usize>(vector: &DMatrix<f64>, index: usize) -> SVector<f64, B> {
    SVector::from_fn(|row, _| vector[(index * B + row, 0)])
}

#[cfg(all(test, feature = "faer"))]
mod tests {
    use super::{BlockMatrix, Factor, Solver};
    use nalgebra::{DMatrix, Matrix3};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// A matrix of a walk with shortcuts, diagonally dominant.
    fn matrix(blocks: usize, rng: &mut ChaCha8Rng) -> BlockMatrix<3> {
        let steps = (1..blocks).map(|block| (block - 1, block));
        let shortcuts = (0..blocks).map(|block| (block, (7 * block + 3) % blocks));
        let pairs: Vec<_> = steps.chain(shortcuts.filter(|(a, b)| a != b)).collect();
        let mut matrix = BlockMatrix::new(blocks, pairs.iter().copied());
        for block in 0..blocks {
            matrix.add_diagonal(block, &Matrix3::from_diagonal_element(30.0));
        }
        for (a, b) in pairs {
            matrix.add(a, b, &Matrix3::from_fn(|_, _| rng.random_range(-1.0..1.0)));
        }
        matrix
    }

    #[test]
    fn dense_and_sparse_agree() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for blocks in [51, 120] {
            let matrix = matrix(blocks, &mut rng);
            let sparse = Solver::new(&matrix).unwrap().factorise(&matrix, &matrix.values).unwrap();
            let dense = Solver::Dense.factorise(&matrix, &matrix.values).unwrap();
            assert!(matches!((&dense, &sparse), (Factor::Dense(_), Factor::Sparse(_))));
            let mut right = DMatrix::from_fn(3 * blocks, 1, |_, _| rng.random_range(-9.0..9.0));
            let mut other = right.clone();
            dense.solve(&mut right);
            sparse.solve(&mut other);
            assert!((right - other).amax() < 1e-12);
            let order = matrix.order();
            let [a, b] = [&dense, &sparse].map(|factor| factor.inverse_blocks::<3>(order));
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).amax() < 1e-12));
        }
    }
}
