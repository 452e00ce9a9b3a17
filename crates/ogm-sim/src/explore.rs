//! Which part of a floor a robot explores, and how it gets about there.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::navigate::{FreeSpace, Node};
use crate::path::smooth;
use crate::wander::wander;
use crate::{FloorPlan, SimError};

/// Distance that way points keep from everything, metres.
const CLEARANCE: f64 = 0.3;
/// Share of the clearance that curves keep.
const CURVE_CLEARANCE: f64 = 0.6;
/// Places of a part that is not visited are closer than this to one that is, metres.
const SPACING: f64 = 3.0;
/// Most places to visit.
const MOST_PLACES: usize = 60;

/// The free space of a floor.
pub(crate) fn free_space(plan: &FloorPlan) -> Result<FreeSpace, SimError> {
    let (frame, solid) = plan.raster(0.05)?;
    let middle = plan.size() / 2.0;
    FreeSpace::largest(&solid, &frame, CLEARANCE)
        .ok_or(SimError::BlockedRoute { x: middle.x, y: middle.y })
}

/// The half plane {p : normal · p ≤ limit}.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    pub(crate) normal: Vector2<f64>,
    pub(crate) limit: f64,
}

impl Part {
    /// The part that holds `share` of the space, seen along `normal`.
    pub(crate) fn holding(share: f64, space: &FreeSpace, normal: Vector2<f64>) -> Self {
        let along = |node: Node| normal.dot(&space.point(node).coords);
        let mut places: Vec<f64> = space.nodes().map(along).collect();
        places.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a count"
        )]
        let last = (share.clamp(0.0, 1.0) * places.len() as f64) as usize;
        let limit = places.get(last.min(places.len().saturating_sub(1)));
        Self { normal, limit: limit.copied().unwrap_or(0.0) }
    }

    fn holds(&self, point: Point2<f64>) -> bool {
        self.normal.dot(&point.coords) <= self.limit
    }
}

/// A path through all of `part`, a point every `step` metres; `None` if no robot fits in there.
pub(crate) fn explore(
    space: &FreeSpace,
    part: &Part,
    step: f64,
    rng: &mut ChaCha8Rng,
) -> Option<Vec<Point2<f64>>> {
    let places = places(space, part, rng);
    let way = wander(space, &places, rng)?;
    let path = smooth(&way, step, |point| space.is_clear(point, CURVE_CLEARANCE)).ok()?;
    (path.len() > 1).then_some(path)
}

/// Nodes of `part` that leave none of it far away, each near the one before.
fn places(space: &FreeSpace, part: &Part, rng: &mut ChaCha8Rng) -> Vec<Node> {
    let nodes: Vec<Node> = space.nodes().filter(|&node| part.holds(space.point(node))).collect();
    if nodes.is_empty() {
        return Vec::new();
    }
    let mut next = nodes[rng.random_range(0..nodes.len())];
    let mut open = Vec::new();
    let mut distance = vec![f64::INFINITY; nodes.len()];
    while open.len() < MOST_PLACES {
        open.push(next);
        let mut furthest = 0.0;
        for (&node, distance) in nodes.iter().zip(&mut distance) {
            *distance =
                distance.min((space.point(node) - space.point(open[open.len() - 1])).norm());
            if *distance > furthest {
                (furthest, next) = (*distance, node);
            }
        }
        if furthest < SPACING {
            break;
        }
    }
    let mut ordered = vec![open.swap_remove(0)];
    while !open.is_empty() {
        let here = space.point(ordered[ordered.len() - 1]);
        let nearest = (0..open.len()).min_by(|&a, &b| {
            let far = |index: usize| (space.point(open[index]) - here).norm();
            far(a).total_cmp(&far(b))
        });
        ordered.push(open.swap_remove(nearest.unwrap_or(0)));
    }
    ordered
}
