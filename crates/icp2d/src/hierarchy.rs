//! Nearest neighbours through the bounding volume hierarchy of parry2d.

use std::cell::Cell;

use nalgebra::{Point2, distance_squared};
use parry2d::bounding_volume::Aabb;
use parry2d::math::Vector;
use parry2d::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use crate::nearest::Nearest;

/// A tree of boxes in single precision over points in double precision.
///
/// The boxes only decide which points are looked at; `slack` covers their rounding, so that the
/// nearest point and ties are decided in double precision.
pub(crate) struct Hierarchy {
    points: Vec<Point2<f64>>,
    tree: Bvh,
    /// Taken off before the cast to single precision, which has no digits to spare for it.
    centre: Point2<f64>,
    /// Largest distance of a point from the centre.
    reach: f64,
}

/// Relative error of a single-precision distance between two points, with room to spare.
const ROUNDING: f64 = 1e-6;

impl Hierarchy {
    pub(crate) fn new(points: &[Point2<f64>]) -> Self {
        let count = points.len().max(1) as f64;
        let sum = points.iter().fold(nalgebra::Vector2::zeros(), |sum, p| sum + p.coords);
        let centre = Point2::from(sum / count);
        let reach = points.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
        let leaves = points.iter().enumerate().map(|(index, point)| {
            let corner = to_single(point - centre);
            (index, Aabb::new(corner, corner))
        });
        Self {
            points: points.to_vec(),
            tree: Bvh::from_iter(BvhBuildStrategy::Binned, leaves),
            centre,
            reach,
        }
    }

    pub(crate) fn nearest(&self, query: Point2<f64>, best: Nearest) -> Nearest {
        let best = Cell::new(best);
        let (at, slack) = self.query(query);
        // Widened, so that boxes at exactly that distance are still looked at.
        let limit = |best: Nearest| narrow(best.others_sq.sqrt() + slack);
        let leaf = |index: u32, _| {
            let mut nearer = best.get();
            nearer.improve(index, distance_squared(&self.points[index as usize], &query));
            best.set(nearer);
            Some(limit(nearer))
        };
        let gap = |node: &BvhNode, _| gap(node, at);
        // Only the best that the leaves left behind is of interest.
        let _ = self.tree.find_best(limit(best.get()), gap, leaf);
        best.get()
    }

    pub(crate) fn for_each_within(
        &self,
        centre: Point2<f64>,
        radius: f64,
        mut visit: impl FnMut(Point2<f64>),
    ) {
        let (at, slack) = self.query(centre);
        let limit = narrow(radius + slack);
        for index in self.tree.leaves(|node| gap(node, at) <= limit) {
            let point = self.points[index as usize];
            if distance_squared(&point, &centre) <= radius * radius {
                visit(point);
            }
        }
    }

    /// The query as the tree sees it, and the error that distances from it may have.
    fn query(&self, query: Point2<f64>) -> (Vector, f64) {
        let offset = query - self.centre;
        (to_single(offset), ROUNDING * (self.reach + offset.norm()) + f64::from(f32::MIN_POSITIVE))
    }
}

impl std::fmt::Debug for Hierarchy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Hierarchy").field("points", &self.points.len()).finish_non_exhaustive()
    }
}

/// Distance from a point to a box.
fn gap(node: &BvhNode, at: Vector) -> f32 {
    (node.mins() - at).max(at - node.maxs()).max(Vector::ZERO).length()
}

fn to_single(offset: nalgebra::Vector2<f64>) -> Vector {
    Vector::new(narrow(offset.x), narrow(offset.y))
}

#[expect(clippy::cast_possible_truncation, reason = "the slack of a query accounts for the error")]
fn narrow(x: f64) -> f32 {
    x as f32
}
