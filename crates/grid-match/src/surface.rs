//! What a correlation says of every translation.

use rustfft::num_complex::Complex32;

/// Scores that are compared at once.
const LANES: usize = 16;

/// The score of every translation, in coarse cells; negative ones wrap around.
pub(crate) struct Surface<'a> {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    pub(crate) scores: &'a [Complex32],
    pub(crate) part: Part,
}

/// Which of the two surfaces that are transformed back as one.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Part {
    Real,
    Imaginary,
}

impl Part {
    pub(crate) fn of(self, both: &Complex32) -> f32 {
        match self {
            Self::Real => both.re,
            Self::Imaginary => both.im,
        }
    }
}

impl Surface<'_> {
    /// The `most` highest local maxima above zero of those that are wanted, highest first: column,
    /// row and score in coarse cells of wall.
    pub(crate) fn maxima(
        &self,
        most: usize,
        is_wanted: impl Fn(usize, usize) -> bool,
    ) -> Vec<(usize, usize, f32)> {
        // One loop for each part, for a choice within would be made for every score.
        match self.part {
            Part::Real => self.maxima_by(|both| Part::Real.of(both), most, is_wanted),
            Part::Imaginary => self.maxima_by(|both| Part::Imaginary.of(both), most, is_wanted),
        }
    }

    fn maxima_by(
        &self,
        score: impl Fn(&Complex32) -> f32,
        most: usize,
        is_wanted: impl Fn(usize, usize) -> bool,
    ) -> Vec<(usize, usize, f32)> {
        let (columns, rows) = (self.columns, self.rows);
        let at = |column: usize, row: usize| score(&self.scores[row * columns + column]);
        let around = |at: usize, count: usize| [(at + count - 1) % count, (at + 1) % count];
        let is_peak = |column: usize, row: usize| {
            let here = at(column, row);
            let ([left, right], [below, above]) = (around(column, columns), around(row, rows));
            let is_between = |near: usize| here > at(near, below) && here >= at(near, above);
            here > at(left, row)
                && here >= at(right, row)
                && [left, column, right].into_iter().all(is_between)
        };
        // Below the lowest of enough that were found, nothing has to be looked at closely.
        let mut floor = 0.0;
        let mut found: Vec<(usize, usize, f32)> = Vec::new();
        for (row, line) in self.scores.chunks_exact(columns).enumerate() {
            for (start, some) in (0..).step_by(LANES).zip(line.chunks(LANES)) {
                // Without a branch, so that all are compared at once.
                if !some.iter().fold(false, |any, both| any | (score(both) > floor)) {
                    continue;
                }
                for (column, here) in (start..).zip(some.iter().map(&score)) {
                    if here > floor && is_peak(column, row) && is_wanted(column, row) {
                        found.push((column, row, here));
                        if found.len() == 4 * most {
                            keep_highest(&mut found, most);
                            floor = found.last().map_or(0.0, |&(.., lowest)| lowest);
                        }
                    }
                }
            }
        }
        keep_highest(&mut found, most);
        let scale = 1.0 / (columns * rows) as f32;
        found.into_iter().map(|(column, row, score)| (column, row, score * scale)).collect()
    }
}

fn keep_highest(maxima: &mut Vec<(usize, usize, f32)>, most: usize) {
    maxima.sort_by(|a, b| b.2.total_cmp(&a.2));
    maxima.truncate(most);
}

#[cfg(test)]
mod tests {
    use super::{Part, Surface};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
    use rustfft::num_complex::Complex32;

    proptest! {
        #[test]
        fn the_highest_maxima_of_those_wanted_are_found(
            columns in 2_usize..40, rows in 2_usize..14, most in 1_usize..4, refused in 0_usize..4,
            heights in prop::collection::vec((-3_i8..9, -3_i8..9), 39 * 13),
            part in prop::sample::select(vec![Part::Real, Part::Imaginary]),
        ) {
            let both = |&(re, im): &(i8, i8)| Complex32::new(re.into(), im.into());
            let scores: Vec<Complex32> = heights[..columns * rows].iter().map(both).collect();
            let surface = Surface { columns, rows, scores: &scores, part };
            let is_wanted = |column: usize, row: usize| (column + row) % 4 != refused;
            let found = surface.maxima(most, is_wanted);
            let at = |column: usize, row: usize| {
                part.of(&scores[row % rows * columns + column % columns])
            };
            // Of equal neighbours the first is one.
            let is_peak = |&(column, row): &(usize, usize)| {
                let here = at(column, row);
                (0..3).flat_map(|dy| (0..3).map(move |dx| (dx, dy))).all(|(dx, dy)| {
                    let near = at(column + columns + dx - 1, row + rows + dy - 1);
                    if (dy, dx) < (1, 1) { here > near } else { here >= near }
                })
            };
            let all = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
            let peaks = all.filter(|&(column, row)| at(column, row) > 0.0 && is_wanted(column, row));
            let scale = 1.0 / (columns * rows) as f32;
            let mut expected: Vec<_> = peaks
                .filter(is_peak)
                .map(|(column, row)| (column, row, at(column, row) * scale))
                .collect();
            expected.sort_by(|a, b| b.2.total_cmp(&a.2));
            expected.truncate(most);
            let heights = |maxima: &[(usize, usize, f32)]| -> Vec<f32> {
                maxima.iter().map(|&(.., height)| height).collect()
            };
            prop_assert_eq!(heights(&found), heights(&expected));
            prop_assert!(found.iter().all(|&(column, row, _)| is_wanted(column, row)));
        }
    }
}
