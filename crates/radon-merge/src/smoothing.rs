//! Edges on both sides of one wall become its middle.

use ogm_core::Grid;

/// Replaces edges that lie closer together than `max_gap` cells by the line midway between them:
/// every column is scanned, then every row of the result (Saeedi et al., Eq. 1 and Fig. 5).
#[must_use]
pub fn smooth_edges(edges: &Grid<bool>, max_gap: usize) -> Grid<bool> {
    let (width, height) = (edges.width(), edges.height());
    let mut vertical = edges.map(|_| false);
    let mut set = Vec::new();
    for column in 0..width {
        set.clear();
        set.extend((0..height).filter(|&row| edges.row(row)[column]));
        for row in scan_line(&set, max_gap) {
            vertical.cells_mut()[row * width + column] = true;
        }
    }
    let mut both = edges.map(|_| false);
    for row in 0..height {
        set.clear();
        set.extend((0..width).filter(|&column| vertical.row(row)[column]));
        for column in scan_line(&set, max_gap) {
            both.cells_mut()[row * width + column] = true;
        }
    }
    both
}

/// One line of the scan: `set` are the positions of its edge cells in ascending order.
///
/// Two consecutive cells that are neither neighbours nor `max_gap` or more apart become the cell
/// midway, rounded down, and take no further part; all others stay.
#[must_use]
fn scan_line(set: &[usize], max_gap: usize) -> Vec<usize> {
    let mut kept = Vec::with_capacity(set.len());
    let mut rest = set;
    while let [first, others @ ..] = rest {
        rest = match others {
            [second, beyond @ ..] if (2..max_gap).contains(&(second - first)) => {
                kept.push(usize::midpoint(*first, *second));
                beyond
            }
            _ => {
                kept.push(*first);
                others
            }
        };
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::{scan_line, smooth_edges};
    use ogm_core::Grid;

    #[test]
    fn t_s1_close_edges_become_their_middle() {
        assert_eq!(scan_line(&[1, 4, 10, 11], 5), [2, 10, 11]);
        assert_eq!(scan_line(&[0, 2, 9, 14], 5), [1, 9, 14]);
        assert!(scan_line(&[], 5).is_empty());
    }

    #[test]
    fn the_two_edges_of_a_wall_of_any_direction_become_one_line() {
        let edges = |set: &dyn Fn(usize, usize) -> bool| {
            let cells = (0..400).map(|i| set(i % 20, i / 20)).collect();
            Grid::new(20, 20, cells).unwrap()
        };
        let upright = smooth_edges(&edges(&|x, _| x == 5 || x == 9), 7);
        assert!(upright.indexed().all(|(at, &set)| set == (at.column == 7)));
        let level = smooth_edges(&edges(&|_, y| y == 5 || y == 9), 7);
        assert!(level.indexed().all(|(at, &set)| set == (at.row == 7)));
        let apart = smooth_edges(&edges(&|_, y| y == 5 || y == 12), 7);
        assert!(apart.indexed().all(|(at, &set)| set == (at.row == 5 || at.row == 12)));
    }
}
