//! Correlation of packed maps over every translation by the fast Fourier transform.

use std::sync::Arc;

use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};

use crate::correlation_planes::CorrelationPlanes;

/// One map transformed, to be correlated with many.
pub(crate) struct Correlator {
    columns: usize,
    rows: usize,
    along_rows: [Arc<dyn Fft<f32>>; 2],
    along_columns: [Arc<dyn Fft<f32>>; 2],
    /// Of the first map, transposed.
    spectrum: Vec<Complex32>,
}

/// Room for one correlation after the other.
pub(crate) struct Workspace {
    work: Vec<Complex32>,
    turned: Vec<Complex32>,
    scratch: Vec<Complex32>,
}

/// The score of every translation, in coarse cells; negative ones wrap around.
pub(crate) struct Surface<'a> {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    scores: &'a [Complex32],
}

impl Correlator {
    /// A correlator for `first` with maps of about `width` × `height` coarse cells, which must
    /// overlap by at least `overlap` cells to either axis, and of at most `room`.
    pub(crate) fn new(
        first: &CorrelationPlanes,
        [width, height]: [usize; 2],
        room: [usize; 2],
        overlap: usize,
    ) -> Self {
        let columns = fast_length((first.width + width).saturating_sub(overlap));
        let rows = fast_length((first.height + height).saturating_sub(overlap));
        let (columns, rows) =
            (columns.max(first.width).max(width), rows.max(first.height).max(height));
        let (columns, rows) = (columns.max(room[0]), rows.max(room[1]));
        let mut planner = FftPlanner::new();
        let mut both =
            |length| [planner.plan_fft_forward(length), planner.plan_fft_inverse(length)];
        let (along_rows, along_columns) = (both(columns), both(rows));
        let mut correlator =
            Self { columns, rows, along_rows, along_columns, spectrum: Vec::new() };
        let mut space = correlator.workspace();
        correlator.transform(first, &mut space);
        correlator.spectrum = space.turned;
        correlator
    }

    /// Cells of a transform.
    pub(crate) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    pub(crate) fn workspace(&self) -> Workspace {
        let ffts = self.along_rows.iter().chain(&self.along_columns);
        let scratch = ffts.map(|fft| fft.get_inplace_scratch_len()).max().unwrap_or(0);
        let zeros = |length| vec![Complex32::default(); length];
        let [work, turned] = [zeros(self.cells()), zeros(self.cells())];
        Workspace { work, turned, scratch: zeros(scratch) }
    }

    /// Re Σ_x first(x + Δ) conj(second(x)) for every Δ.
    pub(crate) fn correlate<'a>(
        &self,
        second: &CorrelationPlanes,
        space: &'a mut Workspace,
    ) -> Surface<'a> {
        self.transform(second, space);
        let Workspace { work, turned, scratch } = space;
        for (value, &first) in turned.iter_mut().zip(&self.spectrum) {
            *value = first * value.conj();
        }
        self.along_columns[1].process_with_scratch(turned, scratch);
        transpose(turned, work, self.rows);
        self.along_rows[1].process_with_scratch(work, scratch);
        Surface { columns: self.columns, rows: self.rows, scores: work }
    }

    /// The transform of `map`, transposed, into what is turned in `space`.
    fn transform(&self, map: &CorrelationPlanes, space: &mut Workspace) {
        let Workspace { work, turned, scratch } = space;
        work.fill(Complex32::default());
        let rows = map.packed.chunks_exact(map.width);
        for (output, row) in work.chunks_exact_mut(self.columns).zip(rows) {
            output[..map.width].copy_from_slice(row);
        }
        let filled = &mut work[..map.height * self.columns];
        self.along_rows[0].process_with_scratch(filled, scratch);
        transpose(work, turned, self.columns);
        self.along_columns[0].process_with_scratch(turned, scratch);
    }
}

impl Surface<'_> {
    /// Unscaled: the inverse transform multiplies by the number of cells.
    pub(crate) fn score(&self, column: usize, row: usize) -> f32 {
        self.scores[row * self.columns + column].re
    }

    /// Local maxima above `floor`: column, row and score in coarse cells of wall.
    pub(crate) fn maxima(&self, floor: f32) -> Vec<(usize, usize, f32)> {
        let (columns, rows) = (self.columns, self.rows);
        let scale = 1.0 / (columns * rows) as f32;
        let mut found = Vec::new();
        for row in 0..rows {
            let around = |at: usize, count: usize| [(at + count - 1) % count, (at + 1) % count];
            let [below, above] = around(row, rows);
            let here = &self.scores[row * columns..][..columns];
            for (column, here) in here.iter().map(|score| score.re).enumerate() {
                if here * scale <= floor {
                    continue;
                }
                let [left, right] = around(column, columns);
                let is_peak = here > self.score(left, row)
                    && here >= self.score(right, row)
                    && [left, column, right].iter().all(|&near| {
                        here > self.score(near, below) && here >= self.score(near, above)
                    });
                if is_peak {
                    found.push((column, row, here * scale));
                }
            }
        }
        found
    }
}

/// The least length not below `least` whose only factors are 2, 3 and 5.
fn fast_length(least: usize) -> usize {
    let smooth = |mut length: usize| {
        for factor in [2, 3, 5] {
            while length.is_multiple_of(factor) {
                length /= factor;
            }
        }
        length == 1
    };
    (least.max(2)..).find(|&length| smooth(length)).unwrap_or(least)
}

/// `input` of `width` columns transposed, in blocks that stay in the cache.
fn transpose(input: &[Complex32], output: &mut [Complex32], width: usize) {
    const BLOCK: usize = 16;
    let height = input.len() / width;
    for row in (0..height).step_by(BLOCK) {
        for column in (0..width).step_by(BLOCK) {
            for y in row..(row + BLOCK).min(height) {
                for x in column..(column + BLOCK).min(width) {
                    output[x * height + y] = input[y * width + x];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Correlator, transpose};
    use crate::correlation_planes::CorrelationPlanes;
    use nalgebra::Vector2;
    use proptest::prelude::{Strategy, prop, prop_assert, proptest};
    use rustfft::num_complex::Complex32;

    fn planes() -> impl Strategy<Value = CorrelationPlanes> {
        let part = -1.0_f32..1.0;
        (1_usize..9, 1_usize..7, prop::collection::vec((part.clone(), part), 8 * 6)).prop_map(
            |(width, height, parts)| {
                let numbers = parts.into_iter().map(|(re, im)| Complex32::new(re, im));
                let packed = numbers.take(width * height).collect();
                CorrelationPlanes { width, height, origin: Vector2::zeros(), packed }
            },
        )
    }

    fn at(map: &CorrelationPlanes, column: usize, row: usize) -> Complex32 {
        let inside = column < map.width && row < map.height;
        if inside { map.packed[row * map.width + column] } else { Complex32::default() }
    }

    proptest! {
        #[test]
        fn every_shift_scores_what_the_sum_over_its_cells_does(
            first in planes(), second in planes(),
        ) {
            let correlator = Correlator::new(&first, [second.width, second.height], [0, 0], 0);
            let mut space = correlator.workspace();
            let surface = correlator.correlate(&second, &mut space);
            let (columns, rows) = (surface.columns, surface.rows);
            let scale = 1.0 / (columns * rows) as f32;
            for row in 0..rows {
                for column in 0..columns {
                    let mut sum = Complex32::default();
                    for y in 0..second.height {
                        for x in 0..second.width {
                            let there = at(&first, (x + column) % columns, (y + row) % rows);
                            sum += there * at(&second, x, y).conj();
                        }
                    }
                    let found = surface.score(column, row) * scale;
                    prop_assert!((found - sum.re).abs() < 1e-4, "{found} instead of {}", sum.re);
                }
            }
        }
    }

    #[test]
    fn a_transpose_puts_rows_into_columns() {
        let numbers: Vec<Complex32> = (0..6_u8).map(|n| Complex32::from(f32::from(n))).collect();
        let mut turned = vec![Complex32::default(); 6];
        transpose(&numbers, &mut turned, 3);
        let real: Vec<f32> = turned.iter().map(|number| number.re).collect();
        assert_eq!(real, [0.0, 3.0, 1.0, 4.0, 2.0, 5.0]);
    }
}
