//! Which occupied cells are the faces of walls: what a robot in the free space could see.

use crate::lattice::floor_index;
use crate::state::State;

/// Occupied cells further than this from free space are not seen, metres: filled outsides, the
/// inside of pillars.
const BEHIND_M: f64 = 0.5;
/// Occupied pieces of at most this side are noise, metres.
const SPECK_M: f64 = 0.055;
/// Thirds of a cell between a cell and its neighbours by side and by corner.
const SIDE: u8 = 3;
const CORNER: u8 = 4;

/// Rows to both sides that decide about a row, for cells of `cell` metres.
pub(crate) fn halo(cell: f64) -> usize {
    deepest(cell).max(speck(cell)) + 2
}

/// Leaves of the occupied cells of `band`, rows of `width`, only the faces of walls; the others
/// become unknown.
pub(crate) fn visible_walls(band: &mut [State], width: usize, cell: f64) {
    erase_specks(band, width, speck(cell));
    let depth = depth(band, width, deepest(cell));
    let deepest = u8::try_from(3 * deepest(cell) + 1).unwrap_or(u8::MAX - 1);
    let size = [width, band.len() / width];
    let is_behind = |at: usize| {
        let own = depth[at];
        let mut around = neighbours([at % width, at / width], size);
        let is_nearer = |near: usize| band[near] == State::Wall && depth[near] + 2 <= own;
        own > deepest || (own > CORNER && around.any(is_nearer))
    };
    let walls = (0..band.len()).filter(|&at| band[at] == State::Wall);
    let behind: Vec<usize> = walls.filter(|&at| is_behind(at)).collect();
    for at in behind {
        band[at] = State::Unknown;
    }
}

/// Cells.
fn deepest(cell: f64) -> usize {
    floor_index((BEHIND_M / cell).round()).max(1)
}

/// Cells of a side.
fn speck(cell: f64) -> usize {
    floor_index(SPECK_M / cell).max(1)
}

/// Thirds of cells to the nearest free cell: 0 in free cells, cut off at 255, and maybe too large
/// beyond `reach` cells. Unknown cells lead as well as occupied ones.
fn depth(band: &[State], width: usize, reach: usize) -> Vec<u8> {
    let height = band.len() / width;
    let mut depth: Vec<u8> =
        band.iter().map(|&cell| if cell == State::Free { 0 } else { u8::MAX }).collect();
    let mut room = Vec::with_capacity(width);
    for row in 0..height {
        let (before, here) = depth.split_at_mut(row * width);
        let here = &mut here[..width];
        if row > 0 {
            lower_from(here, &before[(row - 1) * width..]);
        }
        lower_along(here, reach, &mut room);
    }
    for row in (0..height).rev() {
        let (here, after) = depth[row * width..].split_at_mut(width);
        if row + 1 < height {
            lower_from(here, &after[..width]);
        }
        lower_along(here, reach, &mut room);
    }
    depth
}

/// Lowers a row to what leads to it from the row beside it.
fn lower_from(row: &mut [u8], beside: &[u8]) {
    lower(row, beside, SIDE);
    lower(&mut row[1..], beside, CORNER);
    lower(row, &beside[1..], CORNER);
}

/// Lowers every cell of a row to what leads to it along the row from up to `reach` cells away: from
/// one cell, then from two, four and so on, all at once, where each would wait for the one before.
fn lower_along(row: &mut [u8], reach: usize, room: &mut Vec<u8>) {
    let mut step = 1;
    while step <= reach && step < row.len() {
        room.clear();
        room.extend_from_slice(row);
        let rise = u8::try_from(step).map_or(u8::MAX, |step| step.saturating_mul(SIDE));
        lower(&mut row[step..], room, rise);
        lower(row, &room[step..], rise);
        step *= 2;
    }
}

fn lower(row: &mut [u8], from: &[u8], rise: u8) {
    for (cell, &from) in row.iter_mut().zip(from) {
        *cell = (*cell).min(from.saturating_add(rise));
    }
}

/// Occupied pieces of at most `side` cells either way become unknown: nothing is said about them.
fn erase_specks(band: &mut [State], width: usize, side: usize) {
    let height = band.len() / width;
    let mut piece = Vec::new();
    for start in 0..band.len() {
        if band[start] != State::Wall {
            continue;
        }
        // A piece is looked at from its lowest cell, the leftmost of these.
        let (column, row) = (start % width, start / width);
        let has_lower = (column > 0 && band[start - 1] == State::Wall)
            || (row > 0
                && band[(row - 1) * width..row * width]
                    [column.saturating_sub(1)..=(column + 1).min(width - 1)]
                    .contains(&State::Wall));
        if has_lower {
            continue;
        }
        piece.clear();
        piece.push(start);
        let [mut left, mut right] = [column, column];
        let mut next = 0;
        let mut is_small = true;
        while is_small && next < piece.len() {
            let at = piece[next];
            next += 1;
            for near in neighbours([at % width, at / width], [width, height]) {
                if band[near] == State::Wall && !piece.contains(&near) {
                    let near_column = near % width;
                    (left, right) = (left.min(near_column), right.max(near_column));
                    piece.push(near);
                    is_small &= right - left < side && (near / width).abs_diff(row) < side;
                }
            }
        }
        if is_small {
            for &at in &piece {
                band[at] = State::Unknown;
            }
        }
    }
}

/// Cells that touch the one at `[column, row]` by side or corner, in row-major order.
fn neighbours(
    [column, row]: [usize; 2],
    [width, height]: [usize; 2],
) -> impl Iterator<Item = usize> {
    (row.saturating_sub(1)..=(row + 1).min(height - 1)).flat_map(move |near_row| {
        (column.saturating_sub(1)..=(column + 1).min(width - 1))
            .map(move |near_column| near_row * width + near_column)
            .filter(move |&near| near != row * width + column)
    })
}

#[cfg(test)]
mod tests {
    use super::{CORNER, SIDE, depth};
    use crate::state::State;
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        #[test]
        fn depth_is_the_shortest_way_to_a_free_cell_up_to_its_reach(
            width in 1_usize..40, height in 1_usize..20, reach in 1_usize..30,
            free in prop::collection::vec(0_usize..40 * 20, 0..4),
        ) {
            let mut band = vec![State::Wall; width * height];
            for cell in free {
                band[cell % (width * height)] = State::Free;
            }
            let found = depth(&band, width, reach);
            let step = |at: usize, to: usize| {
                let [across, up] = [(at % width).abs_diff(to % width), (at / width).abs_diff(to / width)];
                let corners = across.min(up);
                usize::from(SIDE) * (across.max(up) - corners) + usize::from(CORNER) * corners
            };
            let most = usize::from(SIDE) * reach + 1;
            for (at, &found) in found.iter().enumerate() {
                let to_free = (0..band.len()).filter(|&to| band[to] == State::Free);
                let brute = to_free.map(|to| step(at, to)).min().unwrap_or(usize::MAX);
                let found = usize::from(found);
                prop_assert!(found == brute || found > most && brute > most, "{found} {brute}");
            }
        }
    }
}
