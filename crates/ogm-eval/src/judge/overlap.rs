//! The two mean squared errors of the walls between an estimated and the true transform.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, Grid, NearestWall, OccupancyGrid, Se2, l2_distance_sq};

use super::error::{PIXEL, PoseError, TransformError};

/// Source walls whose true image lies on, or within three cells of, what the target knows.
///
/// The set does not depend on an estimate, so all methods are judged on the same cells.
#[derive(Debug)]
pub(crate) struct Overlap {
    nearest_wall: Option<NearestWall>,
    true_target_from_source: Se2,
    walls: Vec<Point2<f64>>,
    centroid: Point2<f64>,
}

impl Overlap {
    pub(crate) fn new(
        target: &OccupancyGrid,
        source: &OccupancyGrid,
        true_target_from_source: Se2,
    ) -> Self {
        let thresholds = ClassThresholds::default();
        let known = target.cells().map(|cell| cell.is_known());
        let near_known: Option<Grid<bool>> =
            l2_distance_sq(&known).map(|distance| distance.map(|&d| d <= 9));
        let walls: Vec<_> = source
            .occupied_points(&thresholds)
            .into_iter()
            .filter(|&point| {
                let index = target.cell_at(true_target_from_source * point);
                let near = index.and_then(|index| near_known.as_ref()?.get(index).copied());
                near.unwrap_or(false)
            })
            .collect();
        let sum = walls.iter().fold(Point2::origin(), |sum: Point2<f64>, p| sum + p.coords);
        Self {
            nearest_wall: NearestWall::new(target, &thresholds),
            true_target_from_source,
            centroid: sum / walls.len().max(1) as f64,
            walls,
        }
    }

    /// The errors of an estimate, that of the pose at the centroid of the walls.
    pub(crate) fn errors(&self, target_from_source: &Se2) -> TransformError {
        let (mut disp, mut nn) = (0.0, 0.0);
        for &wall in &self.walls {
            let estimated = *target_from_source * wall;
            disp += (estimated - self.true_target_from_source * wall).norm_squared();
            nn += self.distance_sq_to_wall(estimated);
        }
        let scale = 1.0 / (self.walls.len() as f64 * PIXEL * PIXEL);
        let pose = PoseError::at(self.centroid, target_from_source, &self.true_target_from_source);
        TransformError { mse_disp: disp * scale, mse_nn: nn * scale, pose }
    }

    /// Squared distance to the target wall nearest to the cell of `point`; outside the grid, to
    /// the wall nearest to the closest border cell, which bounds it from above.
    fn distance_sq_to_wall(&self, point: Point2<f64>) -> f64 {
        let nearest = self.nearest_wall.as_ref();
        nearest.map_or(f64::NAN, |walls| (walls.nearest_to(point) - point).norm_squared())
    }
}

#[cfg(test)]
mod tests {
    use super::{Overlap, PIXEL};
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    #[test]
    fn errors_are_zero_at_the_truth_and_grow_with_the_square_of_a_shift() {
        let frame = GridFrame::new(PIXEL, Se2::identity()).unwrap();
        let map =
            OccupancyGrid::from_ascii(frame, "########\n#......#\n#......#\n########").unwrap();
        let overlap = Overlap::new(&map, &map, Se2::identity());
        let exact = overlap.errors(&Se2::identity());
        assert!(exact.mse_disp < 1e-12 && exact.mse_nn < 1e-12, "{exact:?}");

        let shifted = overlap.errors(&Se2::new(3.0 * PIXEL, 4.0 * PIXEL, 0.0));
        assert!((shifted.mse_disp - 25.0).abs() < 1e-9, "{shifted:?}");
        assert!((shifted.pose.displacement - 5.0 * PIXEL).abs() < 1e-12);
        assert!(shifted.mse_nn < shifted.mse_disp);
    }
}
