//! Under what conditions two robots map one floor.

use std::f64::consts::PI;

use nalgebra::Vector2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::params::{DriftParams, LidarParams, MappingParams, PairParams};
use crate::style::MapStyle;

/// Metres between the points of a path.
const STEP: f64 = 0.1;

/// What is drawn about a pair besides the floor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Conditions {
    pub(crate) target: PairParams,
    pub(crate) source: PairParams,
    /// Share of the furniture that stands elsewhere when the second robot comes.
    pub(crate) moved_share: f64,
    /// Who makes the maps.
    pub(crate) styles: [MapStyle; 2],
}

impl Conditions {
    pub(crate) fn draw(rng: &mut ChaCha8Rng) -> Self {
        let seed = rng.random();
        let lidar = lidar(rng);
        let other = if rng.random_bool(0.5) { lidar } else { self::lidar(rng) };
        let resolution = resolution(rng);
        let finer = if rng.random_bool(0.6) { resolution } else { self::resolution(rng) };
        let drift = drift(rng);
        let moved_share = [0.0, 0.0, 0.2, 0.5][rng.random_range(0..4)];
        let params = |lidar, resolution| PairParams {
            seed,
            step: STEP,
            lidar,
            mapping: MappingParams { resolution, ..MappingParams::default() },
            drift,
            ..PairParams::default()
        };
        let styles = [style(rng), style(rng)];
        Self {
            target: params(lidar, resolution),
            source: params(other, finer),
            moved_share,
            styles,
        }
    }
}

fn lidar(rng: &mut ChaCha8Rng) -> LidarParams {
    let (degrees, beams) = [(180.0, 181), (240.0, 683), (270.0, 541), (360.0, 360), (360.0, 720)]
        [rng.random_range(0..5)];
    LidarParams {
        field_of_view: f64::to_radians(degrees * 0.999),
        beams,
        max_range: rng.random_range(3.5..12.0),
        range_sigma: rng.random_range(0.005..0.03),
        quantum: 0.0,
        spurious_share: [0.0, 0.0, 0.003][rng.random_range(0..3)],
        scan_every: rng.random_range(0.5..1.1),
    }
}

fn resolution(rng: &mut ChaCha8Rng) -> f64 {
    [0.05, 0.05, 0.05, 0.03, 0.04, 0.075, 0.1][rng.random_range(0..7)]
}

/// The simulator's own for half of the maps.
fn style(rng: &mut ChaCha8Rng) -> MapStyle {
    let others = &MapStyle::ALL[1..];
    if rng.random_bool(0.5) { MapStyle::Plain } else { others[rng.random_range(0..others.len())] }
}

/// None for two of five pairs, and much for one of ten.
fn drift(rng: &mut ChaCha8Rng) -> DriftParams {
    if rng.random_bool(0.4) {
        return DriftParams::default();
    }
    DriftParams {
        odometry_share: rng.random_range(0.0..0.006),
        compass_sigma: rng.random_range(0.0..0.01),
        bend: if rng.random_bool(0.15) {
            rng.random_range(0.25..0.45)
        } else {
            rng.random_range(0.02..0.25)
        },
    }
}

/// Of length 1.
pub(crate) fn direction(rng: &mut ChaCha8Rng) -> Vector2<f64> {
    let (sin, cos) = rng.random_range(-PI..PI).sin_cos();
    Vector2::new(cos, sin)
}
