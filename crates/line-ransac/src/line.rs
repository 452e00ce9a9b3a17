//! Cells that lie on one line, with its limits and direction.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};
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

    /// Where the wall begins and ends, cells: its limits, or, by total least squares, the outermost
    /// of its cells laid square onto its axis. Where the limits sit on the ends of perpendicular
    /// walls, they lie on a diagonal that leaves the wall.
    pub(crate) fn ends(&self, rule: DirectionRule) -> [Point2<f64>; 2] {
        let as_point = |[x, y]: Cell| Point2::new(f64::from(x), f64::from(y));
        let limits = self.limits.map(as_point);
        if rule == DirectionRule::Endpoints {
            return limits;
        }
        let count = self.cells.len() as f64;
        let sum =
            self.cells.iter().fold(Vector2::zeros(), |sum, &cell| sum + as_point(cell).coords);
        let centre = Point2::from(sum / count);
        let axis = Vector2::new(self.direction.cos(), self.direction.sin());
        let along = self.cells.iter().map(|&cell| axis.dot(&(as_point(cell) - centre)));
        let (least, most) =
            along.fold((0.0_f64, 0.0_f64), |(least, most), at| (least.min(at), most.max(at)));
        let ends = [centre + least * axis, centre + most * axis];
        let is_forward = axis.dot(&(limits[1] - limits[0])) >= 0.0;
        if is_forward { ends } else { [ends[1], ends[0]] }
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
    fn the_ends_of_an_axis_do_not_follow_the_stubs_of_other_walls() {
        let mut wall: Vec<_> = (0..200).map(|x| [x, 0]).collect();
        wall.extend([[0, -2], [0, -1], [199, 1], [199, 2]]);
        let rule = DirectionRule::TotalLeastSquares;
        let line = Line::new(wall, rule).unwrap();
        let [start, end] = line.ends(rule);
        assert!(start.y.abs() < 0.4 && end.y.abs() < 0.4, "{start} {end}");
        assert!((start.x - 0.0).abs() < 0.1 && (end.x - 199.0).abs() < 0.1, "{start} {end}");
        let [start, end] = line.ends(DirectionRule::Endpoints);
        assert!((end.y - start.y).abs() > 3.0, "the limits lie on the diagonal");
    }

    #[test]
    fn directions_stay_in_half_a_turn() {
        for rule in [DirectionRule::Endpoints, DirectionRule::TotalLeastSquares] {
            let upright = Line::new(vec![[4, 0], [4, 9], [4, 5]], rule).unwrap();
            assert_eq!(upright.direction, -std::f64::consts::FRAC_PI_2, "{rule:?}");
        }
    }
}
