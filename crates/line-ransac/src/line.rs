//! Cells that lie on one line, with its limits and direction.

use std::f64::consts::PI;

use ogm_core::wrap_period;

use crate::DirectionRule;
use crate::farthest::{farthest_pair, squared_distance};
use crate::strip::{Cell, difference};

/// Cells that lie on one line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub(crate) cells: Vec<Cell>,
    /// The two cells that lie farthest apart.
    pub(crate) limits: [Cell; 2],
    /// In [−π/2, π/2), along the grid's columns at 0.
    pub(crate) direction: f64,
}

impl Line {
    /// The line of `cells`, or `None` without two different ones.
    pub(crate) fn new(cells: Vec<Cell>, rule: DirectionRule) -> Option<Self> {
        let limits = farthest_pair(&cells)?;
        let direction = match rule {
            DirectionRule::TotalLeastSquares => principal_axis(&cells),
            DirectionRule::Endpoints => direction_between(limits),
        };
        Some(Self { cells, limits, direction: wrap_period(direction, PI) })
    }

    /// Distance between the limits, cells.
    pub(crate) fn length(&self) -> f64 {
        (squared_distance(self.limits[0], self.limits[1]) as f64).sqrt()
    }
}

fn direction_between([a, b]: [Cell; 2]) -> f64 {
    let [x, y] = difference(b, a);
    (y as f64).atan2(x as f64)
}

/// Direction of the largest spread.
fn principal_axis(cells: &[Cell]) -> f64 {
    let count = cells.len() as f64;
    let (mut x_sum, mut y_sum) = (0.0, 0.0);
    for &[x, y] in cells {
        x_sum += f64::from(x);
        y_sum += f64::from(y);
    }
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for &[x, y] in cells {
        let (x, y) = (f64::from(x) - x_sum / count, f64::from(y) - y_sum / count);
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    0.5 * (2.0 * xy).atan2(xx - yy)
}

#[cfg(test)]
mod tests {
    use super::Line;
    use crate::DirectionRule;

    #[test]
    fn t_l5_a_thick_wall_runs_along_its_axis_and_not_its_diagonal() {
        let block: Vec<_> = (0..201).flat_map(|x| (0..7).map(move |y| [x, y])).collect();
        let ends = Line::new(block.clone(), DirectionRule::Endpoints).unwrap();
        let axis = Line::new(block, DirectionRule::TotalLeastSquares).unwrap();
        assert!((ends.direction.to_degrees().abs() - 1.718_358).abs() < 1e-6);
        assert!(axis.direction.abs() < 1e-12);
    }

    #[test]
    fn directions_stay_in_half_a_turn() {
        for rule in [DirectionRule::Endpoints, DirectionRule::TotalLeastSquares] {
            let upright = Line::new(vec![[4, 0], [4, 9], [4, 5]], rule).unwrap();
            assert_eq!(upright.direction, -std::f64::consts::FRAC_PI_2, "{rule:?}");
        }
    }
}
