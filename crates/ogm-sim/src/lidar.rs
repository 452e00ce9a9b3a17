//! What a lidar sees of a plan.

use nalgebra::{Point2, Vector2};
use ogm_core::Se2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::f64::consts::TAU;

use crate::plan::Face;
use crate::{FloorPlan, LidarParams};

/// A lidar in a plan. A scan costs what the visible faces subtend, not beams times faces.
pub(crate) struct Lidar {
    params: LidarParams,
    faces: Vec<Face>,
    /// Beam directions when the robot looks along x.
    beams: Vec<Vector2<f64>>,
    increment: f64,
    turned: Vec<Vector2<f64>>,
    ranges: Vec<f64>,
}

impl Lidar {
    /// `params` must be checked.
    pub(crate) fn new(plan: &FloorPlan, params: &LidarParams) -> Self {
        let increment = params.field_of_view / (params.beams - 1) as f64;
        let beams = params.directions();
        Self {
            params: *params,
            faces: plan.faces().collect(),
            turned: beams.clone(),
            ranges: vec![f64::INFINITY; params.beams],
            beams,
            increment,
        }
    }

    /// The ranges of the last scan.
    pub(crate) fn ranges(&self) -> &[f64] {
        &self.ranges
    }

    /// Beam directions in the robot's own frame.
    pub(crate) fn beams(&self) -> &[Vector2<f64>] {
        &self.beams
    }

    /// Takes a scan: a noisy range for each beam, infinite where nothing returns.
    pub(crate) fn scan(&mut self, world_from_robot: Se2, rng: &mut ChaCha8Rng) -> &[f64] {
        self.true_ranges(world_from_robot);
        for range in &mut self.ranges {
            *range = noisy(*range, &self.params, rng);
        }
        &self.ranges
    }

    /// Fills `ranges` like a depth buffer: each face lowers the beams that it covers.
    fn true_ranges(&mut self, world_from_robot: Se2) {
        let position = Point2::from(world_from_robot.translation());
        let robot_from_world = world_from_robot.inverse();
        for (turned, &beam) in self.turned.iter_mut().zip(&self.beams) {
            *turned = world_from_robot * beam;
        }
        self.ranges.fill(f64::INFINITY);
        let full_turn = TAU / self.increment;
        for face in &self.faces {
            let along = face.end - face.start;
            let normal = Vector2::new(along.y, -along.x);
            let depth = (face.start - position).dot(&normal);
            // Seen from behind, or from within its own line.
            if depth >= 0.0 || face.distance(position) > self.params.max_range {
                continue;
            }
            let bearing = |point: Point2<f64>| {
                let seen = robot_from_world * point;
                seen.y.atan2(seen.x)
            };
            // The solid is left of start → end, so an observer on the right sees end first.
            let right = bearing(face.end);
            let width = (bearing(face.start) - right).rem_euclid(TAU) / self.increment;
            let first = (right + self.params.field_of_view / 2.0).rem_euclid(TAU) / self.increment;
            for first in [first - full_turn, first] {
                let covered = beams_between(first, first + width, self.beams.len());
                let beams = self.turned[covered.clone()].iter();
                for (range, beam) in self.ranges[covered].iter_mut().zip(beams) {
                    let approach = beam.dot(&normal);
                    // Rounding may count a beam that runs along the face.
                    if approach < 0.0 {
                        *range = range.min(depth / approach);
                    }
                }
            }
        }
        for range in &mut self.ranges {
            if *range > self.params.max_range {
                *range = f64::INFINITY;
            }
        }
    }
}

/// Beams from `first` to `last`; a beam through the common corner of two faces belongs to both.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the beams before"
)]
fn beams_between(first: f64, last: f64, beams: usize) -> std::ops::Range<usize> {
    let tolerance = 1e-6;
    let from = (first - tolerance).ceil().clamp(0.0, beams as f64) as usize;
    let to = (last + tolerance).floor().clamp(-1.0, beams as f64 - 1.0) + 1.0;
    from..(to as usize).max(from)
}

fn noisy(range: f64, params: &LidarParams, rng: &mut ChaCha8Rng) -> f64 {
    if range.is_infinite() {
        return range;
    }
    if params.spurious_share > 0.0 && rng.random_bool(params.spurious_share) {
        return rng.random_range(0.0..=range);
    }
    let noise: f64 = rng.sample(StandardNormal);
    let measured = range + params.range_sigma * noise;
    let rounded = if params.quantum > 0.0 {
        (measured / params.quantum).round() * params.quantum
    } else {
        measured
    };
    rounded.clamp(0.0, params.max_range)
}

#[cfg(test)]
mod tests {
    use super::Lidar;
    use crate::draw::{Stream, generator};
    use crate::{FloorPlan, LidarParams};
    use nalgebra::{Point2, Vector2};
    use ogm_core::Se2;

    fn brute_force(plan: &FloorPlan, from: Point2<f64>, beam: Vector2<f64>, limit: f64) -> f64 {
        let crossing = |face: crate::Face| {
            let along = face.end - face.start;
            let denominator = beam.perp(&along);
            let range = (face.start - from).perp(&along) / denominator;
            let share = (face.start - from).perp(&beam) / denominator;
            (range > 0.0 && (0.0..=1.0).contains(&share)).then_some(range)
        };
        let nearest = plan.faces().filter_map(crossing).fold(f64::INFINITY, f64::min);
        if nearest > limit { f64::INFINITY } else { nearest }
    }

    #[test]
    fn every_beam_ends_at_the_first_face_it_crosses() {
        let plan = FloorPlan::plan_a();
        for params in [
            LidarParams { range_sigma: 0.0, beams: 181, ..LidarParams::rf() },
            LidarParams { range_sigma: 0.0, field_of_view: 6.2, beams: 97, ..LidarParams::sa() },
        ] {
            let mut lidar = Lidar::new(&plan, &params);
            let mut rng = generator(0, Stream::Ranges, 0);
            for (x, y, heading) in [(3.4, 3.6, 0.3), (5.0, 6.1, -3.0), (12.4, 6.8, 2.0)] {
                let world_from_robot = Se2::new(x, y, heading);
                let ranges = lidar.scan(world_from_robot, &mut rng).to_vec();
                for (range, &beam) in ranges.into_iter().zip(lidar.beams()) {
                    let direction = world_from_robot * beam;
                    let truth = brute_force(&plan, Point2::new(x, y), direction, params.max_range);
                    assert!(range == truth || (range - truth).abs() < 1e-9, "{range} {truth}");
                }
            }
        }
    }

    #[test]
    fn ranges_scatter_as_the_sensor_says() {
        let plan = FloorPlan::plan_a();
        let noisy = LidarParams { range_sigma: 0.02, ..LidarParams::rf() };
        let exact = LidarParams { range_sigma: 0.0, ..noisy };
        let world_from_robot = Se2::new(3.4, 3.6, 0.3);
        let mut rng = generator(5, Stream::Ranges, 0);
        let truth = Lidar::new(&plan, &exact).scan(world_from_robot, &mut rng).to_vec();
        let mut lidar = Lidar::new(&plan, &noisy);
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
        for _ in 0..20 {
            let measured = lidar.scan(world_from_robot, &mut rng);
            for (measured, truth) in measured.iter().zip(&truth).filter(|(m, _)| m.is_finite()) {
                let error = measured - truth;
                sum += error;
                squares += error * error;
                count += 1.0;
            }
        }
        let (mean, sigma): (f64, f64) = (sum / count, f64::sqrt(squares / count));
        assert!(mean.abs() < 5.0 * 0.02 / f64::sqrt(count), "mean {mean}");
        assert!((sigma - 0.02).abs() < 0.0005, "sigma {sigma}");
    }

    #[test]
    fn spurious_readings_are_short_and_as_many_as_asked_for() {
        let plan = FloorPlan::plan_a();
        let params = LidarParams { spurious_share: 0.1, range_sigma: 0.0, ..LidarParams::rf() };
        let exact = LidarParams { spurious_share: 0.0, ..params };
        let pose = Se2::new(3.4, 3.6, 0.3);
        let mut rng = generator(6, Stream::Ranges, 0);
        let truth = Lidar::new(&plan, &exact).scan(pose, &mut rng).to_vec();
        let mut lidar = Lidar::new(&plan, &params);
        let (mut short, mut returned) = (0.0, 0.0);
        for _ in 0..20 {
            for (measured, truth) in lidar.scan(pose, &mut rng).iter().zip(&truth) {
                assert!(measured <= truth);
                returned += f64::from(u8::from(truth.is_finite()));
                short += f64::from(u8::from(measured < truth));
            }
        }
        let share: f64 = short / returned;
        assert!((share - 0.1).abs() < 0.01, "{share}");
    }
}
