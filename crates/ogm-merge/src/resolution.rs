//! Maps of two resolutions, for the steps that want one.

use std::borrow::Cow;

use ogm_core::{ClassThresholds, OccupancyGrid};

use crate::MergeError;

/// The coarser of the two resolutions, metres a cell.
pub(crate) fn coarser(target: &OccupancyGrid, source: &OccupancyGrid) -> f64 {
    target.frame().resolution().max(source.frame().resolution())
}

/// The map at `resolution`, which is not finer than its own.
pub(crate) fn at_resolution<'a>(
    map: &'a OccupancyGrid,
    resolution: f64,
    thresholds: &ClassThresholds,
) -> Result<Cow<'a, OccupancyGrid>, MergeError> {
    if (map.frame().resolution() / resolution - 1.0).abs() <= 1e-6 {
        Ok(Cow::Borrowed(map))
    } else {
        Ok(Cow::Owned(grid_merge::coarsen(map, resolution, thresholds)?))
    }
}
