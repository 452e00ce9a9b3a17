//! The transform that is right for two maps, bent or not.

use nalgebra::{Point2, Vector2};
use ogm_core::{Se2, wrap_angle};

use crate::bend::Bend;
use crate::pair_bend::shared_walls;
use crate::{RobotRun, SimError};

/// What both robots observed, and how their maps lie on each other there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairTruth {
    /// Maps source points into the target map: exact where both robots knew their poses, else the
    /// least squares fit over the walls that both show, or over the area that both observed where
    /// they share less than two metres of wall.
    pub target_from_source: Se2,
    /// What both observed over what the one that observed less did.
    pub overlap: f64,
    /// Root mean square of what no rigid transform removes, metres.
    pub residual: f64,
    /// Centroid of what is fitted, source frame.
    pub shared_centre: Point2<f64>,
    /// Root mean square distance of what is fitted from its centroid, metres.
    pub shared_radius: f64,
}

impl PairTruth {
    /// Root mean square distance over what is fitted between where `target_from_source` puts a
    /// point and where the truth does, metres.
    #[must_use]
    pub fn displacement(&self, target_from_source: &Se2) -> f64 {
        let (found, truth) = (target_from_source, &self.target_from_source);
        let centre = (*found * self.shared_centre - *truth * self.shared_centre).norm();
        centre.hypot(2.0 * (self.turn(found) / 2.0).sin() * self.shared_radius)
    }

    /// Angle between `target_from_source` and the truth, radians, not negative.
    #[must_use]
    pub fn turn(&self, target_from_source: &Se2) -> f64 {
        wrap_angle(target_from_source.theta() - self.target_from_source.theta()).abs()
    }
}

/// Sampled cells that stand for the area of a map.
const SAMPLES: usize = 20_000;
/// Fewest places of wall that both show, of a tenth of a metre, that a transform is fitted to.
const FEWEST: usize = 20;

/// The truth about two maps whose robots were wrong about their poses; `None` if they share nothing.
pub(crate) fn pair_truth(
    target: &RobotRun,
    source: &RobotRun,
    bends: [&Bend; 2],
) -> Result<Option<PairTruth>, SimError> {
    let source_from_world = source.world_from_map.inverse();
    let (mut target_points, mut source_points) = (Vec::new(), Vec::new());
    let observed = |run: &RobotRun| {
        let cells = run.coverage.cells().iter().filter(|&&seen| seen).count();
        cells as f64 * run.map.frame().resolution().powi(2)
    };
    let stride = target.coverage.cells().len().div_ceil(SAMPLES);
    let mut sampled = 0.0;
    let cells = target.coverage.indexed().filter(|(_, seen)| **seen).map(|(index, _)| index);
    for index in cells.step_by(stride) {
        sampled += 1.0;
        let in_target = target.map.frame().cell_centre(index);
        let displaced = target.world_from_map * in_target;
        // A bend changes little over its own length, so one step back undoes it.
        let place = displaced - bends[0].shift(displaced);
        let in_source = source_from_world * (place + bends[1].shift(place));
        let cell = source.map.cell_at(in_source);
        if cell.is_some_and(|cell| source.coverage.get(cell) == Some(&true)) {
            target_points.push(in_target);
            source_points.push(in_source);
        }
    }
    if target_points.is_empty() {
        return Ok(None);
    }
    let shared = target_points.len() as f64 / sampled * observed(target);
    let overlap = (shared / observed(target).min(observed(source))).min(1.0);
    let walls = shared_walls(target, source);
    if walls.len() >= FEWEST {
        target_points = walls.iter().map(|[target, _]| *target).collect();
        source_points = walls.iter().map(|[_, source]| *source).collect();
    }
    Ok(Some(fit(&target_points, &source_points, overlap)))
}

/// The rigid transform of least squares between points that correspond.
fn fit(target: &[Point2<f64>], source: &[Point2<f64>], overlap: f64) -> PairTruth {
    let count = target.len() as f64;
    let centroid = |points: &[Point2<f64>]| {
        Point2::from(points.iter().map(|point| point.coords).sum::<Vector2<f64>>() / count)
    };
    let (target_centre, source_centre) = (centroid(target), centroid(source));
    let arms = || {
        let pairs = target.iter().zip(source);
        pairs.map(|(target, source)| (target - target_centre, source - source_centre))
    };
    let (cross, dot) = arms().fold((0.0, 0.0), |(cross, dot), (target, source)| {
        (cross + source.perp(&target), dot + source.dot(&target))
    });
    let turn = Se2::new(0.0, 0.0, f64::atan2(cross, dot));
    let offset = target_centre - turn * source_centre;
    let target_from_source = Se2::new(offset.x, offset.y, turn.theta());
    let residual =
        arms().map(|(target, source)| (target - turn * source).norm_squared()).sum::<f64>();
    let spread = arms().map(|(_, source)| source.norm_squared()).sum::<f64>();
    PairTruth {
        target_from_source,
        overlap,
        residual: (residual / count).sqrt(),
        shared_centre: source_centre,
        shared_radius: (spread / count).sqrt(),
    }
}
