//! A drive through the free space of any map.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Refusal, require};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::SimError;
use crate::draw::{Stream, generator};
use crate::navigate::{FreeSpace, Node};
use crate::params::{check_step, positive};
use crate::path::smooth;
use crate::wander::wander;

/// How to drive through a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveParams {
    /// Decides where to.
    pub seed: u64,
    /// Distance kept from everything that is not free, metres; halved, down to a cell and a half,
    /// where it leaves less than a quarter of the free space in one piece.
    pub clearance: f64,
    /// Length of the path, metres; at most a million steps.
    pub length: f64,
    /// Metres between the points of the path, at least 0.001.
    pub step: f64,
}

impl Default for DriveParams {
    /// The radius of a small robot and the path of one of plan A.
    fn default() -> Self {
        Self { seed: 0, clearance: 0.25, length: 40.0, step: 0.03 }
    }
}

/// Longest path in steps.
const MAX_STEPS: f64 = 1e6;
/// Free space that a drive needs in one piece, m².
const SMALLEST_REGION: f64 = 1.0;
/// Share of the free space that one region should hold.
const REGION_SHARE: f64 = 0.25;
/// Below this many cells a disc would pass between cells that touch at a corner.
const SMALLEST_CLEARANCE_CELLS: f64 = 1.5;
/// Curves may come this much closer to obstacles than way points; enough that a clear straight
/// line stays clear when it is sampled more finely.
const CURVE_CLEARANCE: f64 = 0.4;

/// A winding path through the largest connected free space of `map`, each time to a random place
/// far from where it has been, in the map's frame.
///
/// For reading simulated tags with the map of a real robot.
///
/// Refused with [`Refusal::TooLittleFreeSpace`] if no square metre of free space hangs together.
///
/// # Errors
/// A clearance that is not above 0, a step below a millimetre, or a length that is not above 0 or
/// over a million steps.
pub fn drive(
    map: &OccupancyGrid,
    params: &DriveParams,
) -> Result<Outcome<Vec<Point2<f64>>>, SimError> {
    positive("clearance", params.clearance)?;
    check_step(params.step)?;
    let fits = params.length > 0.0 && params.length / params.step <= MAX_STEPS;
    require(fits, "length", "above 0 and at most a million steps", params.length)?;
    Ok(path_through(map, params).into())
}

fn path_through(map: &OccupancyGrid, params: &DriveParams) -> Result<Vec<Point2<f64>>, Refusal> {
    let cell = map.frame().resolution();
    let refusal = |cells: usize| {
        let have_m2 = cells as f64 * cell * cell;
        Refusal::TooLittleFreeSpace { have_m2, need_m2: SMALLEST_REGION }
    };
    let (space, nodes) = region(map, params.clearance).map_err(refusal)?;
    let mut rng = generator(params.seed, Stream::Drive, 0);
    let mut here = nodes[rng.random_range(0..nodes.len())];
    let mut points = vec![space.point(here)];
    let mut left = params.length;
    while left > 0.0 {
        let there = far_node(&space, &nodes, &points, &mut rng);
        let way = wander(&space, &[here, there], &mut rng).ok_or_else(|| refusal(nodes.len()))?;
        for ends in way.windows(2) {
            let piece = ends[1] - ends[0];
            let share = (left / piece.norm()).min(1.0);
            if left > 0.0 && share > 0.0 {
                points.push(ends[0] + piece * share);
            }
            left -= piece.norm();
        }
        // Ends also where rounding leaves no second node to go to.
        left -= params.step;
        here = there;
    }
    let is_clear = |point| space.is_clear(point, CURVE_CLEARANCE);
    let mut path =
        smooth(&points, params.step, is_clear).map_err(|_blocked| refusal(nodes.len()))?;
    path.truncate(points_in(params.length / params.step));
    Ok(path)
}

/// The region to drive in with its nodes, or how many free cells the best one has.
fn region(map: &OccupancyGrid, clearance: f64) -> Result<(FreeSpace, Vec<Node>), usize> {
    let thresholds = ClassThresholds::default();
    let blocked = map.cells().map(|&cell| !thresholds.is_free(cell));
    let resolution = map.frame().resolution();
    let free = blocked.cells().iter().filter(|&&blocked| !blocked).count();
    let wanted = REGION_SHARE * free as f64 * resolution * resolution;
    let smallest = SMALLEST_CLEARANCE_CELLS * resolution;
    let mut clearance = clearance.max(smallest);
    loop {
        let space = FreeSpace::largest(&blocked, map.frame(), clearance);
        let area = space.as_ref().map_or(0.0, FreeSpace::area);
        let last = clearance <= smallest;
        if let Some(space) = space
            && area >= SMALLEST_REGION
            && (area >= wanted || last)
        {
            let nodes = space.nodes().collect();
            return Ok((space, nodes));
        }
        if last {
            return Err(cells_in(area, map));
        }
        clearance = (clearance / 2.0).max(smallest);
    }
}

/// Of a few random nodes, the furthest from where the drive has been: it leaves no corner out.
fn far_node(
    space: &FreeSpace,
    nodes: &[Node],
    driven: &[Point2<f64>],
    rng: &mut ChaCha8Rng,
) -> Node {
    let mut furthest = (nodes[0], f64::NEG_INFINITY);
    for _ in 0..24 {
        let node = nodes[rng.random_range(0..nodes.len())];
        let place = space.point(node);
        let distance_sq =
            driven.iter().map(|point| (point - place).norm_squared()).fold(f64::INFINITY, f64::min);
        if distance_sq > furthest.1 {
            furthest = (node, distance_sq);
        }
    }
    furthest.0
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "an area above 0; saturates"
)]
fn cells_in(area: f64, map: &OccupancyGrid) -> usize {
    let resolution = map.frame().resolution();
    (area / (resolution * resolution)).round() as usize
}

/// Points of a path of `steps` steps.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "steps are above 0; saturates"
)]
fn points_in(steps: f64) -> usize {
    (steps as usize).saturating_add(1)
}

#[cfg(test)]
mod tests {
    use super::{DriveParams, drive};
    use nalgebra::Point2;
    use ogm_core::{ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Refusal, Se2};

    /// A free room of 6 × 4 m with a wall across that leaves a door, and a larger hall that is
    /// not connected to it.
    fn map() -> OccupancyGrid {
        let mut cells = Grid::filled(300, 100, Occupancy::UNKNOWN).unwrap();
        for (position, cell) in cells.cells_mut().iter_mut().enumerate() {
            let (x, y) = (position % 300, position / 300);
            let room = (5..125).contains(&x) && (10..90).contains(&y);
            let wall = (60..63).contains(&x) && !(40..58).contains(&y);
            let hall = (140..290).contains(&x) && (10..90).contains(&y);
            if room || hall {
                *cell = if wall { Occupancy::OCCUPIED } else { Occupancy::FREE };
            }
        }
        let frame = GridFrame::new(0.05, Se2::new(-3.0, 7.0, 0.8)).unwrap();
        OccupancyGrid::new(frame, cells)
    }

    fn path(map: &OccupancyGrid, params: &DriveParams) -> Vec<Point2<f64>> {
        drive(map, params).unwrap().found().unwrap()
    }

    #[test]
    fn a_drive_stays_in_the_largest_free_region_and_winds() {
        let map = map();
        let params = DriveParams { seed: 3, ..DriveParams::default() };
        let path = path(&map, &params);
        let length: f64 = path.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
        assert!((length - 40.0).abs() < 0.5, "{length} m");
        let thresholds = ClassThresholds::default();
        for &point in &path {
            assert!(thresholds.is_free(map.at(point)));
            let cells = map.frame().cells_from_point(point);
            assert!(cells.x > 140.0, "left the hall at {cells}");
        }
        let turned: f64 = crate::path::headings(&path)
            .windows(2)
            .map(|h| ogm_core::wrap_angle(h[1] - h[0]).abs())
            .sum();
        assert!(turned / length > 0.3, "{} rad a metre", turned / length);
    }

    #[test]
    fn a_short_drive_in_a_vast_map_is_as_short_as_asked() {
        let frame = GridFrame::new(1e3, Se2::identity()).unwrap();
        let map = OccupancyGrid::new(frame, Grid::filled(40, 40, Occupancy::FREE).unwrap());
        let path = path(&map, &DriveParams { length: 20.0, ..DriveParams::default() });
        let length: f64 = path.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
        assert!(length <= 20.1, "{length} m");
    }

    #[test]
    fn the_seed_decides_the_drive() {
        let map = map();
        let params = DriveParams { length: 8.0, ..DriveParams::default() };
        assert_eq!(path(&map, &params), path(&map, &params));
        assert_ne!(path(&map, &params), path(&map, &DriveParams { seed: 1, ..params }));
    }

    #[test]
    fn a_robot_too_large_for_the_map_makes_itself_small() {
        let map = map();
        let params = DriveParams { clearance: 30.0, length: 8.0, ..DriveParams::default() };
        assert!(!path(&map, &params).is_empty());
    }

    #[test]
    fn a_map_without_free_space_is_refused() {
        let frame = GridFrame::new(0.05, Se2::identity()).unwrap();
        for cell in [Occupancy::UNKNOWN, Occupancy::OCCUPIED] {
            let map = OccupancyGrid::new(frame, Grid::filled(80, 80, cell).unwrap());
            let outcome = drive(&map, &DriveParams::default()).unwrap();
            let expected = Refusal::TooLittleFreeSpace { have_m2: 0.0, need_m2: 1.0 };
            assert_eq!(outcome.refusal(), Some(&expected));
        }
        let nan = DriveParams { step: f64::NAN, ..DriveParams::default() };
        assert!(drive(&map(), &nan).is_err());
    }
}
