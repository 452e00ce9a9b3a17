//! Correlation of packed maps over every translation by the fast Fourier transform.

use std::sync::Arc;

use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};

use crate::correlation_planes::CorrelationPlanes;
use crate::parallel::both;
use crate::surface::{Part, Surface};

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

/// How the lines of a transform are gone through.
type Lines = fn(&dyn Fft<f32>, &mut [Complex32], &mut Vec<Complex32>);

impl Correlator {
    /// A correlator for `first` with maps of about `width` × `height` coarse cells, which must
    /// overlap by at least `overlap` cells to either axis, and of at most `room`; and room for one
    /// correlation, for large maps spend long on asking for memory.
    pub(crate) fn new(
        first: &CorrelationPlanes,
        [width, height]: [usize; 2],
        room: [usize; 2],
        overlap: usize,
    ) -> (Self, Workspace) {
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
        // Nothing else is to be done yet, and every correlation after this has a thread of its own.
        correlator.transform(first, &mut space, in_halves);
        let spectrum = std::mem::replace(&mut space.turned, correlator.zeros());
        correlator.spectrum = spectrum;
        (correlator, space)
    }

    /// Cells of a transform.
    pub(crate) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    pub(crate) fn workspace(&self) -> Workspace {
        Workspace { work: self.zeros(), turned: self.zeros(), scratch: Vec::new() }
    }

    fn zeros(&self) -> Vec<Complex32> {
        vec![Complex32::default(); self.cells()]
    }

    /// Re Σ_x first(x + Δ) conj(second(x)) for every Δ, and the same of second(−x): of the second map
    /// turned by half about the middle of its cell (0, 0).
    ///
    /// One transform back gives both, for each is real: one goes in as what is even under a change
    /// of sign and conjugation, the other times i.
    pub(crate) fn correlate<'a>(
        &self,
        second: &CorrelationPlanes,
        space: &'a mut Workspace,
    ) -> [Surface<'a>; 2] {
        self.transform(second, space, one_by_one);
        let Workspace { work, turned, scratch } = space;
        for column in 0..=self.columns / 2 {
            let opposite = (self.columns - column) % self.columns;
            let rows = if opposite == column { self.rows / 2 + 1 } else { self.rows };
            for row in 0..rows {
                let here = column * self.rows + row;
                let there = opposite * self.rows + (self.rows - row) % self.rows;
                let (first, first_there) = (self.spectrum[here], self.spectrum[there].conj());
                let (own, own_there) = (turned[here], turned[there]);
                let plain = (first * own.conj() + first_there * own_there) * 0.5;
                let half = (first * own_there.conj() + first_there * own) * 0.5;
                turned[here] = plain + Complex32::I * half;
                turned[there] = plain.conj() + Complex32::I * half.conj();
            }
        }
        one_by_one(&*self.along_columns[1], turned, scratch);
        transpose::transpose(turned, work, self.rows, self.columns);
        one_by_one(&*self.along_rows[1], work, scratch);
        let scores: &[Complex32] = work;
        let (columns, rows) = (self.columns, self.rows);
        [Part::Real, Part::Imaginary].map(|part| Surface { columns, rows, scores, part })
    }

    /// The transform of `map`, transposed, into what is turned in `space`.
    fn transform(&self, map: &CorrelationPlanes, space: &mut Workspace, lines: Lines) {
        let Workspace { work, turned, scratch } = space;
        let (filled, empty) = work.split_at_mut(map.height * self.columns);
        let rows = map.packed.chunks_exact(map.width);
        for (output, row) in filled.chunks_exact_mut(self.columns).zip(rows) {
            let (known, beyond) = output.split_at_mut(map.width);
            known.copy_from_slice(row);
            beyond.fill(Complex32::default());
        }
        empty.fill(Complex32::default());
        lines(&*self.along_rows[0], filled, scratch);
        transpose::transpose(work, turned, self.columns, self.rows);
        lines(&*self.along_columns[0], turned, scratch);
    }
}

fn one_by_one(fft: &dyn Fft<f32>, lines: &mut [Complex32], scratch: &mut Vec<Complex32>) {
    scratch.resize(fft.get_inplace_scratch_len(), Complex32::default());
    fft.process_with_scratch(lines, scratch);
}

fn in_halves(fft: &dyn Fft<f32>, lines: &mut [Complex32], scratch: &mut Vec<Complex32>) {
    let half = lines.len() / fft.len() / 2 * fft.len();
    let (low, high) = lines.split_at_mut(half);
    let mut own = Vec::new();
    both(|| one_by_one(fft, low, scratch), || one_by_one(fft, high, &mut own));
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

#[cfg(test)]
mod tests {
    use super::Correlator;
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
            let size = [second.width, second.height];
            let (correlator, mut space) = Correlator::new(&first, size, [0, 0], 0);
            let [surface, half] = correlator.correlate(&second, &mut space);
            let (columns, rows) = (surface.columns, surface.rows);
            let scale = 1.0 / (columns * rows) as f32;
            for row in 0..rows {
                for column in 0..columns {
                    let (mut sum, mut of_half) = (Complex32::default(), Complex32::default());
                    for y in 0..second.height {
                        for x in 0..second.width {
                            let own = at(&second, x, y).conj();
                            sum += at(&first, (x + column) % columns, (y + row) % rows) * own;
                            let opposite = [columns - x + column, rows - y + row];
                            of_half += at(&first, opposite[0] % columns, opposite[1] % rows) * own;
                        }
                    }
                    for (surface, sum) in [(&surface, sum), (&half, of_half)] {
                        let both = surface.scores[row * columns + column];
                        let found = surface.part.of(&both) * scale;
                        prop_assert!((found - sum.re).abs() < 1e-4, "{found} not {}", sum.re);
                    }
                }
            }
        }
    }
}
