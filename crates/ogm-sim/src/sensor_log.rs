//! What the encoders, gyroscope and laser of a differential-drive robot say along a path.

use nalgebra::{Point2, Vector2};
use ogm_core::{ParameterError, RobotId, Se2, require, wrap_angle};
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::FRAC_PI_3;

use crate::draw::{Stream, generator};
use crate::lidar::Lidar;
use crate::params::{not_negative, positive};
use crate::path::headings;
use crate::{FloorPlan, LidarParams, SimError};

/// The robot steers for the point of its path that lies this far ahead, metres.
const LOOK_AHEAD: f64 = 0.25;
/// Furthest that it goes in a period, metres: less than it looks ahead.
const MAX_STEP: f64 = 0.1;
/// Most that it turns in a period, radians.
const MAX_TURN: f64 = 0.15;
/// It turns on the spot towards what lies further aside, radians.
const MAX_BEARING: f64 = FRAC_PI_3;

/// A differential-drive robot and its sensors; the noise is Gaussian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorParams {
    /// Decides all noise.
    pub seed: u64,
    /// Metres a second; at most 0.1 m a period.
    pub speed: f64,
    /// Seconds between two readings of the encoders and of the gyroscope.
    pub period: f64,
    /// Readings from one scan to the next, at least 1.
    pub readings_per_scan: u32,
    /// Distance between the wheels, metres.
    pub track: f64,
    /// Standard deviation of a wheel's travel after one metre, metres; its variance grows with the
    /// travel.
    pub wheel_sigma_per_root_m: f64,
    /// Standard deviation of a yaw rate, radians a second.
    pub yaw_rate_sigma: f64,
    /// Standard deviation of the gyroscope's bias at the start, radians a second.
    pub bias_sigma: f64,
    /// Growth of the bias's standard deviation in the root of a second, radians a second.
    pub bias_walk: f64,
    /// The laser; its `scan_every` is not used.
    pub lidar: LidarParams,
}

impl SensorParams {
    /// The robots of Saeedi et al., who print the laser only: two scans a second at 0.3 m/s, wheels
    /// that slip, and a MEMS gyroscope whose bias is known to a tenth of a degree a second, as from
    /// standing still.
    #[must_use]
    pub fn sa() -> Self {
        Self {
            seed: 0,
            speed: 0.3,
            period: 0.1,
            readings_per_scan: 5,
            track: 0.35,
            wheel_sigma_per_root_m: 0.02,
            yaw_rate_sigma: 0.01,
            bias_sigma: 0.002,
            bias_walk: 1e-4,
            lidar: LidarParams::sa(),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        positive("speed", self.speed)?;
        positive("period", self.period)?;
        let step = self.speed * self.period;
        require((1e-3..=MAX_STEP).contains(&step), "speed", "0.001 to 0.1 m a period", self.speed)?;
        let scans = f64::from(self.readings_per_scan);
        require(scans >= 1.0, "readings_per_scan", "at least 1", scans)?;
        positive("track", self.track)?;
        not_negative("wheel_sigma_per_root_m", self.wheel_sigma_per_root_m)?;
        not_negative("yaw_rate_sigma", self.yaw_rate_sigma)?;
        not_negative("bias_sigma", self.bias_sigma)?;
        not_negative("bias_walk", self.bias_walk)?;
        self.lidar.check()
    }
}

/// What one robot recorded, with the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorLog {
    /// Where it starts, x forward and y left, in the plan.
    pub world_from_start: Se2,
    /// What it saw there: a range for each of [`LidarParams::directions`], infinite without return.
    pub first_ranges: Vec<f64>,
    /// Everything after that, a sample a period.
    pub samples: Vec<SensorSample>,
}

/// One period.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorSample {
    /// Its end, seconds from the start.
    pub time: f64,
    /// The true pose at its end, in the plan.
    pub world_from_robot: Se2,
    /// Travel of the left wheel by its encoder, metres.
    pub left_m: f64,
    /// Travel of the right wheel by its encoder, metres.
    pub right_m: f64,
    /// Mean yaw rate by the gyroscope, radians a second, counter-clockwise.
    pub yaw_rate: f64,
    /// A range for each of [`LidarParams::directions`], infinite without return; `None` between
    /// scans.
    pub ranges: Option<Vec<f64>>,
}

/// Drives a robot along `path` (plan frame, as from [`FloorPlan::path`]) on arcs and turns on the
/// spot, as two wheels can, and records its sensors.
///
/// It cuts corners by a few centimetres. `robot` chooses the noise.
///
/// # Errors
/// Parameters out of range, or a path that is empty or not finite.
pub fn record_sensors(
    plan: &FloorPlan,
    path: &[Point2<f64>],
    robot: RobotId,
    params: &SensorParams,
) -> Result<SensorLog, SimError> {
    params.check()?;
    require(!path.is_empty(), "points of the path", "at least 1", path.len() as f64)?;
    let mut coordinates = path.iter().flat_map(|point| [point.x, point.y]);
    if let Some(wrong) = coordinates.find(|x| !x.is_finite()) {
        require(false, "a coordinate of the path", "finite", wrong)?;
    }
    let of = |stream| generator(params.seed, stream, robot.0.into());
    let [mut wheels, mut gyroscope, mut laser] =
        [of(Stream::Wheels), of(Stream::Gyroscope), of(Stream::Ranges)];
    let normal = |rng: &mut _| -> f64 { StandardNormal.sample(rng) };
    let mut lidar = Lidar::new(plan, &params.lidar);
    let mut bias = params.bias_sigma * normal(&mut gyroscope);
    let mut world_from_robot = Se2::new(path[0].x, path[0].y, headings(path)[0]);
    let world_from_start = world_from_robot;
    let first_ranges = lidar.scan(world_from_robot, &mut laser).to_vec();
    let mut samples = Vec::new();
    for (count, [travel, turn]) in (1_u32..).zip(Steering::new(path, world_from_robot, params)) {
        world_from_robot = world_from_robot * Se2::exp([travel, 0.0, turn].into());
        let mut wheel = |side: f64| {
            let exact = travel + side * turn * params.track / 2.0;
            exact + params.wheel_sigma_per_root_m * exact.abs().sqrt() * normal(&mut wheels)
        };
        let (left_m, right_m) = (wheel(-1.0), wheel(1.0));
        bias += params.bias_walk * params.period.sqrt() * normal(&mut gyroscope);
        let noise = params.yaw_rate_sigma * normal(&mut gyroscope);
        let is_due = count.is_multiple_of(params.readings_per_scan);
        samples.push(SensorSample {
            time: params.period * f64::from(count),
            world_from_robot,
            left_m,
            right_m,
            yaw_rate: turn / params.period + bias + noise,
            ranges: is_due.then(|| lidar.scan(world_from_robot, &mut laser).to_vec()),
        });
    }
    Ok(SensorLog { world_from_start, first_ranges, samples })
}

/// The travel and turn of each period: pure pursuit of a path, of which every point is passed
/// within the distance that it looks ahead.
struct Steering<'a> {
    path: &'a [Point2<f64>],
    ahead: usize,
    world_from_robot: Se2,
    step: f64,
}

impl<'a> Steering<'a> {
    fn new(path: &'a [Point2<f64>], world_from_robot: Se2, params: &SensorParams) -> Self {
        Self { path, ahead: 0, world_from_robot, step: params.speed * params.period }
    }
}

impl Iterator for Steering<'_> {
    type Item = [f64; 2];

    fn next(&mut self) -> Option<[f64; 2]> {
        let robot_from_world = self.world_from_robot.inverse();
        let offset = loop {
            let offset: Vector2<f64> = (robot_from_world * *self.path.get(self.ahead)?).coords;
            if offset.norm() >= LOOK_AHEAD {
                break offset;
            }
            self.ahead += 1;
        };
        let bearing = wrap_angle(offset.y.atan2(offset.x));
        let motion = if bearing.abs() > MAX_BEARING {
            [0.0, MAX_TURN.copysign(bearing)]
        } else {
            let curvature = 2.0 * bearing.sin() / offset.norm();
            [self.step, (curvature * self.step).clamp(-MAX_TURN, MAX_TURN)]
        };
        let [travel, turn] = motion;
        self.world_from_robot = self.world_from_robot * Se2::exp([travel, 0.0, turn].into());
        Some(motion)
    }
}

#[cfg(test)]
mod tests {
    use super::{SensorLog, SensorParams, record_sensors};
    use crate::{FloorPlan, LidarParams, MappingParams, SOURCE, TARGET, map_scans};
    use nalgebra::{Point2, Vector2};
    use ogm_core::{ClassThresholds, RobotId, Se2, wrap_angle};

    fn log(robot: RobotId, params: &SensorParams) -> SensorLog {
        let plan = FloorPlan::plan_b();
        let path = plan.path(robot, 0.03).unwrap();
        record_sensors(&plan, &path, robot, params).unwrap()
    }

    fn exact() -> SensorParams {
        SensorParams {
            wheel_sigma_per_root_m: 0.0,
            yaw_rate_sigma: 0.0,
            bias_sigma: 0.0,
            bias_walk: 0.0,
            lidar: LidarParams { range_sigma: 0.0, ..LidarParams::sa() },
            ..SensorParams::sa()
        }
    }

    #[test]
    fn exact_wheels_and_yaw_rates_add_up_to_the_true_pose() {
        let params = exact();
        for robot in [TARGET, SOURCE] {
            let log = log(robot, &params);
            let (mut pose, mut heading) = (log.world_from_start, log.world_from_start.theta());
            for sample in &log.samples {
                let turn = (sample.right_m - sample.left_m) / params.track;
                let travel = f64::midpoint(sample.left_m, sample.right_m);
                pose = pose * Se2::exp([travel, 0.0, turn].into());
                heading += sample.yaw_rate * params.period;
                let there = sample.world_from_robot;
                assert!((pose.translation() - there.translation()).norm() < 1e-9);
                assert!(wrap_angle(heading - there.theta()).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_robot_follows_its_path_to_the_end_and_keeps_clear_of_walls() {
        let plan = FloorPlan::plan_b();
        for robot in [TARGET, SOURCE] {
            let path = plan.path(robot, 0.03).unwrap();
            let log = log(robot, &exact());
            for sample in &log.samples {
                let at = Point2::from(sample.world_from_robot.translation());
                assert!(plan.is_clear(at, 0.1), "{at}");
                let off = path.iter().map(|point| (point - at).norm());
                assert!(off.fold(f64::INFINITY, f64::min) < 0.15, "{at}");
            }
            let end = log.samples.last().unwrap().world_from_robot.translation();
            assert!((path.last().unwrap().coords - end).norm() < 0.3);
        }
    }

    #[test]
    fn noise_is_as_large_as_asked_for() {
        let params = SensorParams { bias_sigma: 0.0, bias_walk: 0.0, ..SensorParams::sa() };
        let [noisy, truth] = [params, exact()].map(|params| log(TARGET, &params));
        let pairs = || noisy.samples.iter().zip(&truth.samples);
        let root_mean_square = |values: Vec<f64>| {
            (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
        };
        let wheels = pairs().filter(|(_, truth)| truth.left_m != 0.0);
        let wheel = root_mean_square(
            wheels.map(|(a, b)| (a.left_m - b.left_m) / b.left_m.abs().sqrt()).collect(),
        );
        assert!((wheel - 0.02).abs() < 0.002, "{wheel}");
        let yaw_rate = root_mean_square(pairs().map(|(a, b)| a.yaw_rate - b.yaw_rate).collect());
        assert!((yaw_rate - 0.01).abs() < 0.001, "{yaw_rate}");
    }

    #[test]
    fn scans_from_true_poses_make_the_map_of_the_plan() {
        let params = SensorParams::sa();
        let log = log(SOURCE, &params);
        let plan = FloorPlan::plan_b();
        let start_from_world = log.world_from_start.inverse();
        let scans: Vec<(Se2, &[f64])> = log
            .samples
            .iter()
            .filter_map(|sample| {
                let ranges = sample.ranges.as_deref()?;
                Some((start_from_world * sample.world_from_robot, ranges))
            })
            .collect();
        assert_eq!(scans.len(), log.samples.len() / 5);
        let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
        let map = map_scans(&scans, &mapping, &params.lidar).unwrap();
        let walls = map.occupied_points(&ClassThresholds::default());
        assert!(walls.len() > 500, "{}", walls.len());
        let far =
            walls.iter().filter(|&&at| plan.distance_to_face(log.world_from_start * at) > 0.08);
        assert!(far.count() * 50 < walls.len());
    }

    #[test]
    fn what_cannot_be_meant_is_an_error() {
        let plan = FloorPlan::plan_b();
        let path = [Point2::new(3.0, 5.0), Point2::new(4.0, 5.0)];
        let fails = |path: &[Point2<f64>], params: SensorParams| {
            assert!(record_sensors(&plan, path, TARGET, &params).is_err(), "{params:?}");
        };
        fails(&[], exact());
        fails(&[Point2::from(Vector2::new(f64::NAN, 1.0))], exact());
        fails(&path, SensorParams { speed: 20.0, ..exact() });
        fails(&path, SensorParams { track: 0.0, ..exact() });
        fails(&path, SensorParams { readings_per_scan: 0, ..exact() });
        fails(&path, SensorParams { bias_walk: f64::INFINITY, ..exact() });
    }
}
