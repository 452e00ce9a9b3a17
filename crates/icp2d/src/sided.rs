//! The nearest wall that was seen from a given side.

use std::f64::consts::{FRAC_PI_4, TAU};

use nalgebra::{Point2, Vector2};

use crate::WallPoints;
use crate::nearest::Nearest;
use crate::nearest_index::NearestIndex;

/// Free sides within 70 degrees agree, as they do for [`IcpParams::min_side_cosine`].
///
/// [`IcpParams::min_side_cosine`]: crate::IcpParams::min_side_cosine
const MIN_SIDE_COSINE: f64 = 0.3;

/// Directions that a free side is sorted into.
const SECTORS: usize = 8;

/// Indices over the points that agree with each of eight free sides, and over all of them.
#[derive(Debug)]
pub(crate) struct SidedIndex {
    by_side: Vec<Option<NearestIndex>>,
    all: NearestIndex,
    min: Point2<f64>,
    max: Point2<f64>,
}

impl SidedIndex {
    /// `None` for no points.
    pub(crate) fn new(walls: &WallPoints) -> Option<Self> {
        let points = walls.points();
        let first = points.first()?.position;
        let index = |positions: Vec<Point2<f64>>| {
            (!positions.is_empty()).then(|| NearestIndex::new(&positions, walls.spacing()))
        };
        let sectors = (0..SECTORS).map(|sector| {
            let (sin, cos) = (FRAC_PI_4 * sector as f64).sin_cos();
            let middle = Vector2::new(cos, sin);
            let agrees = |side: Vector2<f64>| side.dot(&middle) > MIN_SIDE_COSINE;
            let agreeing = points.iter().filter(|point| point.free_side.is_none_or(agrees));
            index(agreeing.map(|point| point.position).collect())
        });
        let positions = || points.iter().map(|point| point.position);
        Some(Self {
            by_side: sectors.collect(),
            all: NearestIndex::new(&positions().collect::<Vec<_>>(), walls.spacing()),
            min: positions().fold(first, |min, p| min.inf(&p)),
            max: positions().fold(first, |max, p| max.sup(&p)),
        })
    }

    /// Whether `point` lies in the box around all points, grown by `margin`.
    pub(crate) fn is_near(&self, point: Point2<f64>, margin: f64) -> bool {
        let margin = Vector2::repeat(margin);
        self.min - margin <= point && point <= self.max + margin
    }

    /// Squared distance to the nearest point at most `radius` away whose free side agrees with
    /// `side`; any point agrees where either has none.
    pub(crate) fn distance_sq(
        &self,
        point: Point2<f64>,
        side: Option<Vector2<f64>>,
        radius: f64,
    ) -> Option<f64> {
        let index = match side {
            Some(side) => self.by_side[sector(side)].as_ref()?,
            None => &self.all,
        };
        let nearest = index.nearest(point, Nearest::none_within(radius));
        nearest.is_found().then_some(nearest.distance_sq)
    }
}

/// The sector whose middle is nearest to the direction of `side`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of a turn in [0, 1]"
)]
fn sector(side: Vector2<f64>) -> usize {
    let share = side.y.atan2(side.x).rem_euclid(TAU) / TAU;
    (share * SECTORS as f64).round() as usize % SECTORS
}
