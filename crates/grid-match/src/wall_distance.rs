//! How far every cell is from the nearest wall, up to where nobody asks any more.

use crate::lattice::{Lattice, floor_index};
use crate::state::State;
use crate::surroundings::{Distance, FARTHEST_M};

/// The distance of every cell.
///
/// Exact, with the lower-envelope scan of Meijster, Roerdink and Hesselink, *A general algorithm for
/// computing distance transforms in linear time* (2000); but what is further than [`FARTHEST_M`] is
/// left out, which is most of a large map and makes numbers small.
#[expect(clippy::cast_possible_truncation, reason = "a resolution in single precision")]
pub(crate) fn wall_distance(state: &[State], lattice: &Lattice) -> Vec<Distance> {
    let reach = floor_index((FARTHEST_M / lattice.resolution).ceil()).min(MOST_REACH);
    let across = distance_in_columns(state, lattice.width, reach as u16);
    let mut distance = vec![Distance::FARTHEST; state.len()];
    let mut envelope = Envelope { parabolas: Vec::new(), reach: reach as i64 };
    let rows = distance.chunks_exact_mut(lattice.width);
    for (output, across) in rows.zip(across.chunks_exact(lattice.width)) {
        envelope.rebuild(across);
        envelope.write(output, lattice.resolution as f32);
    }
    distance
}

/// Most cells of a reach: squares of distances stay below 2³¹ then.
const MOST_REACH: usize = 30_000;

/// Cells to the nearest wall of the same column, more than `reach` where that is further.
fn distance_in_columns(state: &[State], width: usize, reach: u16) -> Vec<u16> {
    let start = |&cell: &State| if cell == State::Wall { 0 } else { reach + 1 };
    let mut distance: Vec<u16> = state.iter().map(start).collect();
    let lower_from = |row: &mut [u16], beside: &[u16]| {
        for (cell, &from) in row.iter_mut().zip(beside) {
            *cell = (*cell).min(from + 1);
        }
    };
    let height = distance.len() / width;
    for row in 1..height {
        let (before, here) = distance.split_at_mut(row * width);
        lower_from(&mut here[..width], &before[(row - 1) * width..]);
    }
    for row in (1..height).rev() {
        let (before, here) = distance.split_at_mut(row * width);
        lower_from(&mut before[(row - 1) * width..], &here[..width]);
    }
    distance
}

/// The lower envelope of the parabolas (x − column)² + height of one row.
struct Envelope {
    parabolas: Vec<Parabola>,
    reach: i64,
}

#[derive(Clone, Copy)]
struct Parabola {
    column: i64,
    height: i64,
    /// First column where this parabola is the lowest.
    from: i64,
}

impl Parabola {
    fn at(&self, x: i64) -> i64 {
        (x - self.column) * (x - self.column) + self.height
    }

    /// Last column where this parabola is not above `right`, which starts further right.
    fn last_before(&self, right: &Self) -> i64 {
        let apart = right.column - self.column;
        let rise = right.height - self.height + apart * (right.column + self.column);
        // Most parabolas have their neighbour in the next column, and a division costs the most.
        if apart == 1 { rise >> 1 } else { rise.div_euclid(2 * apart) }
    }
}

impl Envelope {
    fn rebuild(&mut self, across: &[u16]) {
        self.parabolas.clear();
        let end = across.len() as i64;
        for (column, rise) in (0_i64..).zip(across.iter().copied().map(i64::from)) {
            if rise > self.reach {
                continue;
            }
            let mut next = Parabola { column, height: rise * rise, from: 0 };
            while self.parabolas.last().is_some_and(|last| last.at(last.from) > next.at(last.from))
            {
                self.parabolas.pop();
            }
            if let Some(last) = self.parabolas.last() {
                next.from = last.last_before(&next) + 1;
            }
            if next.from < end {
                self.parabolas.push(next);
            }
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "columns of a row, and squares of less than the reach"
    )]
    fn write(&self, output: &mut [Distance], resolution: f32) {
        let ends = self.parabolas.iter().skip(1).map(|next| next.from).chain([output.len() as i64]);
        for (parabola, end) in self.parabolas.iter().zip(ends) {
            let from = parabola.from.max(parabola.column - self.reach);
            let end = end.min(parabola.column + self.reach + 1);
            let first = (from - parabola.column) as i32;
            let cells = output.get_mut(from as usize..end as usize).unwrap_or_default();
            for (across, cell) in (first..).zip(cells) {
                let square = across * across + parabola.height as i32;
                *cell = Distance::of_metres((square as f32).sqrt() * resolution);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::wall_distance;
    use crate::lattice::Lattice;
    use crate::state::State;
    use crate::surroundings::FARTHEST_M;
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        #[test]
        fn it_is_the_least_distance_to_any_wall_cut_off(
            width in 1_usize..24, height in 1_usize..24, power in -4.0_f64..3.0,
            walls in prop::collection::vec(0_usize..24 * 24, 0..6),
        ) {
            let lattice = Lattice::new(width, height, 10.0_f64.powf(power));
            let mut state = vec![State::Free; width * height];
            for wall in walls {
                state[wall % (width * height)] = State::Wall;
            }
            let found = wall_distance(&state, &lattice);
            for (at, distance) in found.iter().enumerate() {
                let to = |wall| (lattice.centre(wall) - lattice.centre(at)).norm();
                let walls = (0..state.len()).filter(|&cell| state[cell] == State::Wall);
                let brute = walls.map(to).fold(FARTHEST_M, f64::min);
                prop_assert!((distance.metres() - brute).abs() < 1e-4, "{distance:?} {brute}");
            }
        }
    }
}
