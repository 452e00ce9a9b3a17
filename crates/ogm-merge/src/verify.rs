//! Whether two maps show the same walls where they lie over each other.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, NearestWall, OccupancyGrid, Se2};

use crate::WallAgreement;

/// Walls this close count as the same, cells of the map they are looked up in.
const REACH_CELLS: f64 = 2.0;

/// Compares the walls of either map with what the other knows at their place.
pub(crate) fn wall_agreement(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
    thresholds: &ClassThresholds,
) -> WallAgreement {
    let mut counts = WallAgreement::default();
    for (map, other, map_from_other) in
        [(target, source, target_from_source), (source, target, target_from_source.inverse())]
    {
        let Some(nearest) = NearestWall::new(map, thresholds) else { continue };
        for wall in other.occupied_points(thresholds) {
            let place: Point2<f64> = map_from_other * wall;
            let Some(index) = map.cell_at(place) else { continue };
            if !map.cells().get(index).is_some_and(|cell| cell.is_known()) {
                continue;
            }
            counts.compared += 1;
            let reach = REACH_CELLS * map.frame().resolution();
            let distance = (nearest.nearest_to(place) - place).norm();
            counts.agreeing += usize::from(distance <= reach);
        }
    }
    counts
}
