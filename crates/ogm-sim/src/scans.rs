//! A map of scans that were placed by whoever knows where.

use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Se2, require};

use crate::mapping::Mapper;
use crate::{LidarParams, MappingParams, SimError};

/// Furthest that a scan may lie from the origin, metres: cells are counted exactly up to there.
const MAX_COORDINATE: f64 = 1e6;

/// The occupancy grid of scans taken at `map_from_robot`, each with a range for every one of
/// [`LidarParams::directions`], infinite where nothing returned.
///
/// # Errors
/// Parameters out of range, no scan, a scan without a finite pose or with another number of
/// ranges, or a map over the size limit.
pub fn map_scans(
    scans: &[(Se2, &[f64])],
    mapping: &MappingParams,
    lidar: &LidarParams,
) -> Result<OccupancyGrid, SimError> {
    mapping.check()?;
    lidar.check()?;
    require(!scans.is_empty(), "scans", "at least 1", scans.len() as f64)?;
    for (map_from_robot, ranges) in scans {
        let is_near =
            map_from_robot.is_finite() && map_from_robot.translation().amax() <= MAX_COORDINATE;
        require(is_near, "the pose of a scan (its x)", "within 1000 km", map_from_robot.x())?;
        let count = ranges.len() as f64;
        require(ranges.len() == lidar.beams, "ranges of a scan", "one a beam", count)?;
        let in_reach =
            |range: &&f64| !(**range >= 0.0 && (**range <= lidar.max_range || range.is_infinite()));
        if let Some(&wrong) = ranges.iter().find(in_reach) {
            require(false, "a range", "0 to max_range, or infinite", wrong)?;
        }
    }
    let positions: Vec<_> =
        scans.iter().map(|(pose, _)| Point2::from(pose.translation())).collect();
    let mut mapper = Mapper::new(mapping, &positions, lidar.max_range)?;
    let beams = lidar.directions();
    for (map_from_robot, ranges) in scans {
        mapper.add_scan(*map_from_robot, &beams, ranges, lidar.max_range);
    }
    let (map, _) = mapper.finish(None)?;
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::map_scans;
    use crate::{LidarParams, MappingParams};
    use ogm_core::Se2;

    #[test]
    fn scans_that_cannot_be_meant_are_errors() {
        let lidar = LidarParams { beams: 3, ..LidarParams::sa() };
        let mapping = MappingParams::default();
        let map = |pose: Se2, ranges: &[f64]| map_scans(&[(pose, ranges)], &mapping, &lidar);
        let here = Se2::identity();
        assert!(map(here, &[1.0, f64::INFINITY, 4.5]).is_ok());
        assert!(map(here, &[1.0, 2.0]).is_err());
        assert!(map(here, &[1.0, 2.0, 4.6]).is_err());
        assert!(map(here, &[1.0, 2.0, -0.1]).is_err());
        assert!(map(here, &[1.0, 2.0, f64::NAN]).is_err());
        assert!(map(Se2::new(f64::NAN, 0.0, 0.0), &[1.0; 3]).is_err());
        assert!(map(Se2::new(1e9, 0.0, 0.0), &[1.0; 3]).is_err());
        assert!(map_scans(&[], &mapping, &lidar).is_err());
    }
}
