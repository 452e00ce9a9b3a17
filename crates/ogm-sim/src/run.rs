//! One robot drives, scans and reads.

use nalgebra::Point2;
use ogm_core::{Grid, OccupancyGrid, RobotId, Se2, TagReading, require};
use rand::RngExt;
use rand_distr::StandardNormal;
use std::f64::consts::PI;

use crate::bend::Bend;
use crate::draw::{Stream, generator};
use crate::lidar::Lidar;
use crate::mapping::{CellBox, Mapper};
use crate::params::check_step;
use crate::path::{headings, smooth};
use crate::shown::Shown;
use crate::tags::read_along;
use crate::{FloorPlan, PairParams, SOURCE, SimError, TARGET};

/// Furthest coordinate of a path, metres: cells are counted exactly up to there.
const MAX_COORDINATE: f64 = 1e6;

/// A robot keeps this far from everything, metres.
const CLEARANCE: f64 = 0.2;

/// What a robot brings home.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotRun {
    /// Its map, in its map frame.
    pub map: OccupancyGrid,
    /// Which cells of the map its lidar observed.
    pub coverage: Grid<bool>,
    /// Every tag reading, in the order of the path.
    pub readings: Vec<TagReading>,
    /// The true pose of its map frame in the plan.
    pub world_from_map: Se2,
    /// Where it believes to have been, in its map frame; the truth if there is no drift.
    pub path: Vec<Point2<f64>>,
    /// Where its map shows what it hit.
    pub(crate) shown: Shown,
}

impl FloorPlan {
    /// The path of a robot through its way points, a point every `step` metres, plan frame.
    ///
    /// Smoothed by Catmull-Rom splines, because only a curved path locates tags; straight where
    /// the curve would come too close to a wall.
    ///
    /// # Errors
    /// A step below a millimetre, way points that lead closer than 0.2 m to something, or a robot
    /// that the plan has no route for.
    pub fn path(&self, robot: RobotId, step: f64) -> Result<Vec<Point2<f64>>, SimError> {
        check_step(step)?;
        let is_clear = |point| self.is_clear(point, CLEARANCE);
        let route = self.route(robot).ok_or(SimError::NoRoute { robot })?;
        smooth(route, step, is_clear).map_err(|at| SimError::BlockedRoute { x: at.x, y: at.y })
    }
}

/// A robot's map frame: at the start of its path, turned by `heading` radians in the plan.
pub(crate) fn frame_at_start(path: &[Point2<f64>], heading: f64) -> Se2 {
    let start = path.first().copied().unwrap_or_else(Point2::origin);
    Se2::new(start.x, start.y, heading)
}

/// The random heading of a robot's map frame.
pub(crate) fn random_heading(seed: u64, robot: RobotId) -> f64 {
    generator(seed, Stream::Heading, robot.0.into()).random_range(-PI..PI)
}

/// Sends a robot along `path` (plan frame, as from [`FloorPlan::path`]) and maps what it sees in
/// the frame whose pose in the plan is `world_from_map`.
///
/// `robot` chooses the noise: two robots on one path see different things.
///
/// # Errors
/// Parameters out of range, an empty or non-finite path, or a map over the size limit.
pub fn map_along_path(
    plan: &FloorPlan,
    path: &[Point2<f64>],
    tags: &[(u32, Point2<f64>)],
    world_from_map: Se2,
    robot: RobotId,
    params: &PairParams,
) -> Result<RobotRun, SimError> {
    map_along_paths(plan, &[(robot, path)], tags, world_from_map, params, None)
}

/// Maps a plan along both of its paths in one grid, in a frame with the plan's origin turned by
/// `map_heading` radians; the grid covers at least the plan.
///
/// At heading 0 the map of plan A is the axis-aligned one of 700 × 600 cells. There are no tags.
///
/// # Errors
/// Parameters out of range, a blocked path, or a map over the size limit.
pub fn survey(
    plan: &FloorPlan,
    map_heading: f64,
    params: &PairParams,
) -> Result<RobotRun, SimError> {
    let world_from_map = Se2::new(0.0, 0.0, map_heading);
    let target = plan.path(TARGET, params.step)?;
    let source = plan.path(SOURCE, params.step)?;
    let paths = [(TARGET, target.as_slice()), (SOURCE, source.as_slice())];
    let size = plan.size();
    // A corner on a lattice line belongs to the cell inside the plan.
    let inset = 1e-6;
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(x, y)| {
        let inside = |share: f64, side: f64| (share * side).clamp(inset, side - inset);
        Point2::new(inside(x, size.x), inside(y, size.y))
    });
    map_along_paths(plan, &paths, &[], world_from_map, params, Some(&corners))
}

fn map_along_paths(
    plan: &FloorPlan,
    paths: &[(RobotId, &[Point2<f64>])],
    tags: &[(u32, Point2<f64>)],
    world_from_map: Se2,
    params: &PairParams,
    keep: Option<&[Point2<f64>]>,
) -> Result<RobotRun, SimError> {
    params.check()?;
    for (_, path) in paths {
        let mut coordinates = path.iter().flat_map(|point| [point.x, point.y]);
        if let Some(wrong) = coordinates.find(|x| x.is_nan() || x.abs() > MAX_COORDINATE) {
            require(false, "a coordinate of the path", "within 1000 km", wrong)?;
        }
        let points = path.len() as f64;
        require(points > 0.0, "points of the path", "at least 1", points)?;
    }
    let theta = world_from_map.theta();
    let is_near = world_from_map.translation().amax() <= MAX_COORDINATE && theta.is_finite();
    let requirement = "finite, and its place within 1000 km";
    require(is_near, "world_from_map (its heading)", requirement, theta)?;
    let map_from_world = world_from_map.inverse();
    let drives: Vec<Drive> = paths
        .iter()
        .map(|&(robot, path)| Drive::new(robot, path, map_from_world, params))
        .collect();
    let believed: Vec<_> = drives.iter().flat_map(|drive| drive.believed.clone()).collect();
    let max_range = params.lidar.max_range;
    let mut mapper = Mapper::new(&params.mapping, &believed, max_range)?;
    let mut lidar = Lidar::new(plan, &params.lidar);
    let mut readings = Vec::new();
    let mut shown = Shown::default();
    for drive in &drives {
        let mut rng = generator(params.seed, Stream::Ranges, drive.robot.0.into());
        let mut compass = generator(params.seed, Stream::Compass, drive.robot.0.into());
        for index in scan_points(drive.path.len(), params) {
            let heading = drive.headings[index];
            let world_from_robot = Se2::new(drive.path[index].x, drive.path[index].y, heading);
            let error = params.drift.compass_sigma * compass.sample::<f64, _>(StandardNormal)
                + drive.bend.turn(drive.path[index]);
            let at = drive.believed[index];
            let map_from_robot = Se2::new(at.x, at.y, heading - world_from_map.theta() + error);
            lidar.scan(world_from_robot, &mut rng);
            mapper.add_scan(map_from_robot, lidar.beams(), lidar.ranges(), max_range);
            let place_from_robot = map_from_world * world_from_robot;
            shown.add_scan(place_from_robot, map_from_robot, lidar.beams(), lidar.ranges());
        }
        let true_path: Vec<_> = drive.path.iter().map(|&p| map_from_world * p).collect();
        let tags: Vec<_> = tags.iter().map(|&(id, tag)| (id, map_from_world * tag)).collect();
        let (seed, robot) = (params.seed, drive.robot);
        readings.extend(read_along(&true_path, &drive.believed, &tags, &params.tags, seed, robot)?);
    }
    let keep = keep.and_then(|corners| {
        CellBox::around(mapper.lattice(), corners.iter().map(|&p| map_from_world * p))
    });
    let (map, coverage) = mapper.finish(keep)?;
    Ok(RobotRun { map, coverage, readings, world_from_map, path: believed, shown })
}

/// How the map of a robot is bent, in the plan.
pub(crate) fn bend(robot: RobotId, params: &PairParams) -> Bend {
    let mut rng = generator(params.seed, Stream::Bend, robot.0.into());
    Bend::draw(params.drift.bend, &mut rng)
}

/// Where a robot is and where it believes to be.
struct Drive<'a> {
    robot: RobotId,
    path: &'a [Point2<f64>],
    headings: Vec<f64>,
    bend: Bend,
    /// In the map frame.
    believed: Vec<Point2<f64>>,
}

impl<'a> Drive<'a> {
    fn new(
        robot: RobotId,
        path: &'a [Point2<f64>],
        map_from_world: Se2,
        params: &PairParams,
    ) -> Self {
        let mut rng = generator(params.seed, Stream::Drift, robot.0.into());
        let bend = bend(robot, params);
        let mut error = nalgebra::Vector2::zeros();
        let mut before = path.first();
        let believed = path
            .iter()
            .map(|point| {
                let travelled = before.map_or(0.0, |before| (point - before).norm());
                before = Some(point);
                let sigma = params.drift.odometry_share * travelled.sqrt();
                error +=
                    nalgebra::Vector2::from_fn(|_, _| sigma * rng.sample::<f64, _>(StandardNormal));
                map_from_world * (point + error + bend.shift(*point))
            })
            .collect();
        Self { robot, path, headings: headings(path), bend, believed }
    }
}

/// The points of a path where a scan is due.
fn scan_points(points: usize, params: &PairParams) -> impl Iterator<Item = usize> {
    let every = params.lidar.scan_every;
    let mut next = 0.0;
    (0..points).filter(move |&index| {
        let travelled = index as f64 * params.step;
        // Half a step either way, so that rounding of multiples does not skip a point.
        let due = travelled + params.step / 2.0 > next;
        if due {
            next += every.max(params.step);
        }
        due
    })
}
