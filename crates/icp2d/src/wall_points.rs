//! Points on walls, and the side from which they were seen.

use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, ClassThresholds, OccupancyGrid};

use crate::IcpError;
use crate::hierarchy::Hierarchy;
use crate::nearest::Nearest;

/// A point on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint {
    /// Where it is in its map frame, metres.
    pub position: Point2<f64>,
    /// Unit vector towards the free space in front of it, in the map frame; `None` agrees with
    /// every side.
    pub free_side: Option<Vector2<f64>>,
}

/// Valid wall points of one map.
#[derive(Debug, Clone, PartialEq)]
pub struct WallPoints {
    points: Vec<WallPoint>,
    spacing: f64,
}

/// Cells around an occupied one, to each side, that say where its free space is: a window of
/// 7 × 7 sees past a wall two cells thick.
const WINDOW: usize = 3;

/// Largest magnitude of a coordinate, metres: beyond it double precision falls short of a map.
const MAX_COORDINATE: f64 = 1e9;

impl WallPoints {
    /// The wall points `points`, about `spacing` metres apart along a wall.
    ///
    /// # Errors
    /// A position that is not finite or beyond 10⁹ m, a free side whose length is not 1 to 1e-6,
    /// or a spacing that is not finite and positive.
    pub fn from_points(points: Vec<WallPoint>, spacing: f64) -> Result<Self, IcpError> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(IcpError::InvalidSpacing { spacing });
        }
        for (index, point) in points.iter().enumerate() {
            let (x, y) = (point.position.x, point.position.y);
            // NaN fails this comparison too.
            if !(x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE) {
                let limit = MAX_COORDINATE;
                return Err(IcpError::InvalidPoint { index, x, y, limit });
            }
            if let Some(side) = point.free_side {
                let is_unit = (side.norm() - 1.0).abs() <= 1e-6;
                if !is_unit {
                    let (x, y) = (side.x, side.y);
                    return Err(IcpError::InvalidFreeSide { index, x, y });
                }
            }
        }
        Ok(Self { points, spacing })
    }

    /// Plain points without free sides, about as far apart as the median distance to the nearest
    /// other one.
    ///
    /// # Errors
    /// A point that is not finite or beyond 10⁹ m.
    pub fn from_positions(positions: &[Point2<f64>]) -> Result<Self, IcpError> {
        let as_wall = |&position: &Point2<f64>| WallPoint { position, free_side: None };
        let points: Vec<WallPoint> = positions.iter().map(as_wall).collect();
        // Checked before anything is measured.
        let mut walls = Self::from_points(points, 1.0)?;
        walls.spacing = median_spacing(positions).unwrap_or(1.0);
        Ok(walls)
    }

    /// The occupied cells of a map, row-major; the spacing is its resolution.
    ///
    /// The free side of a cell is the direction of the sum of the offsets to the free cells in the
    /// window of 7 × 7 cells around it, `None` where the sum is zero.
    ///
    /// # Errors
    /// A map that lies beyond 10⁹ m.
    pub fn from_grid(map: &OccupancyGrid, thresholds: &ClassThresholds) -> Result<Self, IcpError> {
        let map_from_grid = map.frame().map_from_grid();
        let mut points = Vec::new();
        for (index, &cell) in map.cells().indexed() {
            if !thresholds.is_occupied(cell) {
                continue;
            }
            let offsets = sum_of_free_offsets(map, thresholds, index);
            points.push(WallPoint {
                position: map.frame().cell_centre(index),
                free_side: offsets.try_normalize(0.5).map(|side| map_from_grid * side),
            });
        }
        Self::from_points(points, map.frame().resolution())
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &[WallPoint] {
        &self.points
    }

    /// Metres between neighbours on a wall.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }
}

/// Median distance to the nearest other point, metres; `None` without two different points.
///
/// From every so many points, at most a thousand: a median asks for no more.
fn median_spacing(positions: &[Point2<f64>]) -> Option<f64> {
    let index = Hierarchy::new(positions);
    let every = positions.len().div_ceil(1000).max(1);
    let mut distances: Vec<f64> = positions
        .iter()
        .step_by(every)
        .map(|&point| index.nearest(point, Nearest::none_within(f64::INFINITY)).others_sq.sqrt())
        .filter(|&distance| distance.is_finite() && distance > 0.0)
        .collect();
    let middle = distances.len() / 2;
    if distances.is_empty() {
        return None;
    }
    let (_, &mut median, _) = distances.select_nth_unstable_by(middle, f64::total_cmp);
    Some(median)
}

/// In cells; zero or at least 1 long.
fn sum_of_free_offsets(
    map: &OccupancyGrid,
    thresholds: &ClassThresholds,
    at: CellIndex,
) -> Vector2<f64> {
    let left = at.column.saturating_sub(WINDOW);
    let right = (at.column + WINDOW + 1).min(map.width());
    let bottom = at.row.saturating_sub(WINDOW);
    let top = (at.row + WINDOW + 1).min(map.height());
    let (mut count, mut columns, mut rows) = (0, 0, 0);
    for row in bottom..top {
        let mut free_in_row = 0;
        for (column, &cell) in (left..).zip(&map.cells().row(row)[left..right]) {
            let free = usize::from(thresholds.is_free(cell));
            free_in_row += free;
            columns += free * column;
        }
        count += free_in_row;
        rows += free_in_row * row;
    }
    let offset = |sum: usize, centre: usize| sum as f64 - (count * centre) as f64;
    Vector2::new(offset(columns, at.column), offset(rows, at.row))
}

#[cfg(test)]
mod tests {
    use super::WallPoints;
    use nalgebra::{Point2, Vector2};
    use ogm_core::{ClassThresholds, GridFrame, OccupancyGrid, Se2};
    use std::f64::consts::FRAC_PI_2;

    fn free_sides(origin: Se2, picture: &str) -> Vec<Option<Vector2<f64>>> {
        let frame = GridFrame::new(0.1, origin).unwrap();
        let map = OccupancyGrid::from_ascii(frame, picture).unwrap();
        let walls = WallPoints::from_grid(&map, &ClassThresholds::default()).unwrap();
        walls.points().iter().map(|point| point.free_side).collect()
    }

    #[test]
    fn the_free_side_is_where_the_free_cells_are() {
        let one_face = "?????????\n???###???\n.........\n.........";
        for side in free_sides(Se2::identity(), one_face) {
            assert!(side.unwrap().y < -0.9, "{side:?}");
        }
        let from_left = free_sides(Se2::identity(), "..#??");
        assert_eq!(from_left, [Some(-Vector2::x())]);
    }

    #[test]
    fn a_cell_seen_from_both_sides_or_none_has_no_free_side() {
        assert_eq!(free_sides(Se2::identity(), "..#.."), [None]);
        assert_eq!(free_sides(Se2::identity(), "??#??"), [None]);
        assert_eq!(free_sides(Se2::identity(), ".??#"), [Some(-Vector2::x())]);
        // Free cells four away are outside of the window.
        assert_eq!(free_sides(Se2::identity(), ".???#"), [None]);
    }

    #[test]
    fn positions_and_sides_turn_with_the_origin() {
        let frame = GridFrame::new(0.1, Se2::new(1.0, 2.0, FRAC_PI_2)).unwrap();
        let map = OccupancyGrid::from_ascii(frame, "#..").unwrap();
        let walls = WallPoints::from_grid(&map, &ClassThresholds::default()).unwrap();
        let point = walls.points()[0];
        assert!((point.position - Point2::new(0.95, 2.05)).norm() < 1e-12);
        assert!((point.free_side.unwrap() - Vector2::y()).norm() < 1e-12);
    }
}
