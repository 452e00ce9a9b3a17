//! The certainty of a posterior: the mass of its best window of cells.

use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, Grid};

use crate::CertaintyWindow;

/// Windows further than this many cells from the winner belong to another peak.
const FAR_CELLS: usize = 10;

/// The winning window of a posterior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Peak {
    pub(crate) mass: f64,
    /// Probability-weighted, in continuous cell coordinates.
    pub(crate) centroid: Point2<f64>,
    pub(crate) middle: CellIndex,
    /// Mass of the best far window over that of the winner; 0 where no window is far.
    pub(crate) second_ratio: f64,
}

impl Peak {
    /// The best window of `side` × `side` cells; of equal ones the lowest, then the leftmost.
    pub(crate) fn of(posterior: &Grid<f64>, side: usize, rule: CertaintyWindow) -> Self {
        let stride = match rule {
            CertaintyWindow::Sliding => 1,
            CertaintyWindow::Disjoint => side,
        };
        let windows = window_masses(posterior, side, stride);
        let best = largest(&windows, |_| true);
        let second = largest(&windows, |window| {
            let dx = window.column.abs_diff(best.column);
            let dy = window.row.abs_diff(best.row);
            dx * dx + dy * dy > FAR_CELLS * FAR_CELLS
        });
        Self {
            mass: best.mass,
            centroid: centroid(posterior, best, side),
            middle: CellIndex { column: best.column + side / 2, row: best.row + side / 2 },
            second_ratio: second.mass / best.mass,
        }
    }
}

/// The most probable cell; of equal ones the lowest, then the leftmost.
pub(crate) fn most_probable(posterior: &Grid<f64>) -> CellIndex {
    let mut best = (0, 0.0);
    for (position, &mass) in posterior.cells().iter().enumerate() {
        if mass > best.1 {
            best = (position, mass);
        }
    }
    posterior.index_of(best.0)
}

/// A window by its lowest, leftmost cell.
#[derive(Debug, Clone, Copy)]
struct Window {
    column: usize,
    row: usize,
    mass: f64,
}

/// All windows row by row; the last disjoint one of a row or column may be cut off by the border.
fn window_masses(posterior: &Grid<f64>, side: usize, stride: usize) -> Vec<Window> {
    let starts = |cells: usize| {
        let sliding = cells + 1 - side;
        let end = if stride == 1 { sliding } else { cells };
        (0..end).step_by(stride)
    };
    let sums_in_row = |cells: &[f64]| -> Vec<f64> {
        starts(cells.len()).map(|column| cells.iter().skip(column).take(side).sum()).collect()
    };
    let rows: Vec<Vec<f64>> = posterior.rows().map(sums_in_row).collect();
    let mut windows = Vec::new();
    for row in starts(posterior.height()) {
        let first = windows.len();
        windows.extend(starts(posterior.width()).map(|column| Window { column, row, mass: 0.0 }));
        for sums in rows.iter().skip(row).take(side) {
            for (window, sum) in windows[first..].iter_mut().zip(sums) {
                window.mass += sum;
            }
        }
    }
    windows
}

fn largest(windows: &[Window], is_candidate: impl Fn(&Window) -> bool) -> Window {
    let mut best = Window { column: 0, row: 0, mass: 0.0 };
    for window in windows {
        if window.mass > best.mass && is_candidate(window) {
            best = *window;
        }
    }
    best
}

fn centroid(posterior: &Grid<f64>, window: Window, side: usize) -> Point2<f64> {
    let mut moment = Vector2::zeros();
    for row in window.row..(window.row + side).min(posterior.height()) {
        for column in window.column..(window.column + side).min(posterior.width()) {
            if let Some(&mass) = posterior.get(CellIndex { column, row }) {
                moment += mass * Vector2::new(column as f64 + 0.5, row as f64 + 0.5);
            }
        }
    }
    Point2::from(moment / window.mass)
}

#[cfg(test)]
mod tests {
    use super::{Peak, most_probable};
    use crate::CertaintyWindow::{Disjoint, Sliding};
    use nalgebra::Point2;
    use ogm_core::{CellIndex, Grid};

    /// Samples at the cell centres, normalised.
    fn gaussian(side: usize, mean: Point2<f64>, sd: f64) -> Grid<f64> {
        let cells = (0..side * side)
            .map(|at| {
                let centre = Point2::new((at % side) as f64 + 0.5, (at / side) as f64 + 0.5);
                (-(centre - mean).norm_squared() / (2.0 * sd * sd)).exp()
            })
            .collect();
        let mut grid = Grid::new(side, side, cells).unwrap();
        let sum: f64 = grid.cells().iter().sum();
        grid.cells_mut().iter_mut().for_each(|cell| *cell /= sum);
        grid
    }

    #[test]
    fn t_r4_a_tag_on_a_block_corner_is_stuck_at_a_quarter() {
        let posterior = gaussian(30, Point2::new(15.0, 15.0), 0.6);
        assert!((Peak::of(&posterior, 3, Disjoint).mass - 0.250).abs() < 0.001);
        assert!((Peak::of(&posterior, 3, Sliding).mass - 0.942).abs() < 0.002);
    }

    #[test]
    fn certainty_follows_the_spread_of_the_posterior() {
        // Spread in cells; tag on a block corner, disjoint and sliding; tag in a block centre, both.
        for (sd, disjoint, sliding, centred) in [
            (0.4, 0.250, 0.998, 1.000),
            (0.6, 0.250, 0.942, 0.990),
            (0.8, 0.250, 0.822, 0.913),
            (1.0, 0.249, 0.695, 0.779),
        ] {
            let corner = gaussian(30, Point2::new(15.0, 15.0), sd);
            let centre = gaussian(30, Point2::new(16.5, 16.5), sd);
            for (posterior, rule, expected) in [
                (&corner, Disjoint, disjoint),
                (&corner, Sliding, sliding),
                (&centre, Disjoint, centred),
                (&centre, Sliding, centred),
            ] {
                let mass = Peak::of(posterior, 3, rule).mass;
                assert!((mass - expected).abs() < 0.002, "{sd} {rule:?}: {mass}");
            }
        }
    }

    #[test]
    fn the_centroid_is_finer_than_a_cell() {
        let mean = Point2::new(12.3, 17.6);
        let posterior = gaussian(30, mean, 0.5);
        let centroid = Peak::of(&posterior, 3, Sliding).centroid;
        assert!((centroid - mean).norm() < 0.05, "{centroid}");
        let mode = most_probable(&posterior);
        assert_eq!(mode, CellIndex { column: 12, row: 17 });
    }

    #[test]
    fn of_equal_peaks_the_lowest_then_the_leftmost_wins() {
        let mut posterior = Grid::filled(40, 40, 0.0).unwrap();
        for (column, row) in [(30, 5), (20, 5), (3, 33)] {
            *posterior.get_mut(CellIndex { column, row }).unwrap() = 1.0 / 3.0;
        }
        assert_eq!(most_probable(&posterior), CellIndex { column: 20, row: 5 });
        let peak = Peak::of(&posterior, 3, Sliding);
        assert_eq!(peak.middle, CellIndex { column: 19, row: 4 });
        assert_eq!(peak.second_ratio, 1.0, "the other two peaks are far");
    }

    #[test]
    fn the_shoulder_of_one_peak_is_not_a_second_peak() {
        let ratio = Peak::of(&gaussian(40, Point2::new(20.0, 20.0), 1.0), 3, Sliding).second_ratio;
        assert!(ratio < 1e-6, "{ratio}");
    }

    #[test]
    fn blocks_cut_off_by_the_border_still_count() {
        let mut posterior = Grid::filled(10, 10, 0.0).unwrap();
        *posterior.get_mut(CellIndex { column: 9, row: 9 }).unwrap() = 1.0;
        let peak = Peak::of(&posterior, 3, Disjoint);
        assert_eq!((peak.mass, peak.centroid), (1.0, Point2::new(9.5, 9.5)));
    }
}
