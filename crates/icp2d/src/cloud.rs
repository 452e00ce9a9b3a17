//! The points of one map, ready to be searched.

use nalgebra::{Point2, Vector2};

use crate::WallPoint;
use crate::nearest_index::NearestIndex;

/// The points of one map that take part.
#[derive(Debug)]
pub(crate) struct Cloud {
    pub(crate) positions: Vec<Point2<f64>>,
    pub(crate) free_sides: Vec<Option<Vector2<f64>>>,
    pub(crate) nearest: NearestIndex,
    pub(crate) spacing: f64,
}

impl Cloud {
    pub(crate) fn new(points: impl Iterator<Item = WallPoint>, spacing: f64) -> Self {
        let (positions, free_sides): (Vec<_>, Vec<_>) =
            points.map(|point| (point.position, point.free_side)).unzip();
        let nearest = NearestIndex::new(&positions, spacing);
        Self { positions, free_sides, nearest, spacing }
    }
}
