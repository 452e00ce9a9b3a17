//! The two cells of a set that lie farthest apart.

use crate::strip::{Cell, difference};

/// The farthest pair of `cells`, in lexicographic order and the smallest such pair on a tie;
/// `None` without two different cells.
///
/// Both belong to the convex hull, which for the cells of a line has few corners.
pub(crate) fn farthest_pair(cells: &[Cell]) -> Option<[Cell; 2]> {
    let corners = hull_corners(cells);
    let mut farthest = None;
    let mut longest = 0;
    for (index, &a) in corners.iter().enumerate() {
        for &b in &corners[index + 1..] {
            let length = squared_distance(a, b);
            if length > longest {
                longest = length;
                farthest = Some([a, b]);
            }
        }
    }
    farthest
}

pub(crate) fn squared_distance(a: Cell, b: Cell) -> i64 {
    let [x, y] = difference(a, b);
    x * x + y * y
}

/// Corners of the convex hull in lexicographic order, by Andrew's monotone chain.
fn hull_corners(cells: &[Cell]) -> Vec<Cell> {
    let mut sorted = cells.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let mut corners = chain(&sorted, 1);
    corners.extend(chain(&sorted, -1));
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// The lower chain of the hull for `side` 1, the upper for -1.
fn chain(sorted: &[Cell], side: i64) -> Vec<Cell> {
    let mut chain: Vec<Cell> = Vec::new();
    for &cell in sorted {
        while let [.., a, b] = chain[..]
            && side * turn(a, b, cell) <= 0
        {
            chain.pop();
        }
        chain.push(cell);
    }
    chain
}

/// Positive for a left turn.
fn turn(a: Cell, b: Cell, c: Cell) -> i64 {
    let ([x1, y1], [x2, y2]) = (difference(b, a), difference(c, a));
    x1 * y2 - y1 * x2
}

#[cfg(test)]
mod tests {
    use super::{farthest_pair, squared_distance};
    use proptest::prelude::{prop, prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn equals_brute_force(
            cells in prop::collection::vec([-6_i32..6, -6_i32..6], 0..30),
        ) {
            let mut best = None;
            for &a in &cells {
                for &b in &cells {
                    let candidate = (-squared_distance(a, b), [a, b]);
                    if a < b && best.is_none_or(|best| candidate < best) {
                        best = Some(candidate);
                    }
                }
            }
            prop_assert_eq!(farthest_pair(&cells), best.map(|(_, pair)| pair));
        }
    }
}
