//! Winding ways from goal to goal.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::navigate::{FreeSpace, Node};

/// A stretch longer than this is bent, metres: along a straight line a tag has a mirror image.
const STRAIGHT: f64 = 1.0;
/// How far a bend may leave the straight line, metres.
const BEND: f64 = 0.35;

/// Way points from goal to goal by shortest ways, with bends in long straight stretches; every
/// line between two of them is clear. `None` if two goals are not connected.
pub(crate) fn wander(
    space: &FreeSpace,
    goals: &[Node],
    rng: &mut ChaCha8Rng,
) -> Option<Vec<Point2<f64>>> {
    let mut points: Vec<_> = goals.first().map(|&goal| space.point(goal)).into_iter().collect();
    for ends in goals.windows(2) {
        let way = space.way(ends[0], ends[1])?;
        for stretch in space.straightened(&way).windows(2) {
            points.extend(bent(space, stretch[0], stretch[1], rng));
        }
    }
    Some(points)
}

/// Points from `from` to `to`, without `from`.
fn bent(
    space: &FreeSpace,
    from: Point2<f64>,
    to: Point2<f64>,
    rng: &mut ChaCha8Rng,
) -> Vec<Point2<f64>> {
    let along = to - from;
    let length = along.norm();
    let side = Vector2::new(-along.y, along.x) / length;
    let mut bend = BEND;
    for _ in 0..4 {
        let mut points = vec![from];
        let mut at = STRAIGHT * rng.random_range(0.6..1.0);
        let mut sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
        while at < length - 0.4 * STRAIGHT {
            let offset = sign * bend * rng.random_range(0.5..1.0);
            points.push(from + along * (at / length) + side * offset);
            sign = -sign;
            at += STRAIGHT * rng.random_range(0.8..1.4);
        }
        points.push(to);
        if points.windows(2).all(|ends| space.is_clear_between(ends[0], ends[1])) {
            points.remove(0);
            return points;
        }
        bend /= 2.0;
    }
    vec![to]
}
