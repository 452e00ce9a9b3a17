//! Nearest neighbours of points that move less and less.

use nalgebra::{Point2, distance, distance_squared};

use crate::cloud::Cloud;
use crate::nearest::Nearest;

/// Remembers for each moving point its nearest fixed point and how far it may move before another
/// could be nearer, after Greenspan and Godin, *A nearest neighbor method for efficient ICP*.
///
/// The answers are those of a search each time; most of the searches are saved.
#[derive(Debug)]
pub(crate) struct Tracker {
    seen: Vec<Seen>,
    /// How much further than needed a search looks, metres, to have something to save later.
    slack: f64,
}

/// What the last search of a point found.
#[derive(Debug, Clone, Copy)]
struct Seen {
    from: Point2<f64>,
    nearest: u32,
    /// Distance from there to every other fixed point, at least, metres.
    others: f64,
}

impl Tracker {
    pub(crate) fn new(count: usize, spacing: f64) -> Self {
        let nothing = Seen { from: Point2::origin(), nearest: u32::MAX, others: f64::NEG_INFINITY };
        Self { seen: vec![nothing; count], slack: spacing }
    }

    /// Index and squared distance of the fixed point nearest to moving point `index`, now at
    /// `query`, if it is at most `radius` away.
    pub(crate) fn nearest(
        &mut self,
        index: usize,
        query: Point2<f64>,
        fixed: &Cloud,
        radius: f64,
    ) -> Option<(u32, f64)> {
        let seen = &mut self.seen[index];
        // Rounding must not decide between two points.
        let others = seen.others - distance(&seen.from, &query) - 1e-6 * self.slack;
        let mut start = Nearest::none_within(radius + self.slack);
        if let Some(point) = fixed.positions.get(seen.nearest as usize) {
            let distance_sq = distance_squared(point, &query);
            let last = distance_sq.sqrt();
            if last < others {
                return (last <= radius).then_some((seen.nearest, distance_sq));
            }
            if last < radius {
                start = Nearest::hint(seen.nearest, distance_sq, self.slack);
            }
        } else if radius < others {
            return None;
        }
        let found = fixed.nearest.nearest(query, start);
        *seen = Seen { from: query, nearest: found.index, others: found.others_sq.sqrt() };
        (found.is_found() && found.distance_sq <= radius * radius)
            .then_some((found.index, found.distance_sq))
    }
}

#[cfg(test)]
mod tests {
    use super::Tracker;
    use crate::WallPoint;
    use crate::cloud::Cloud;
    use crate::nearest::Nearest;
    use nalgebra::{Point2, Vector2};
    use proptest::prelude::{prop, prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn a_tracked_point_finds_what_a_fresh_search_finds(
            fixed in prop::collection::vec((-9_i32..9, -9_i32..9), 1..60),
            walk in prop::collection::vec((-1.0_f64..1.0, -1.0_f64..1.0, 0_i32..8, 0.0_f64..6.0), 1..40),
        ) {
            let wall = fixed.iter().map(|&(x, y)| WallPoint {
                position: Point2::new(f64::from(x), f64::from(y)),
                free_side: None,
            });
            let fixed = Cloud::new(wall, 1.0);
            let mut tracker = Tracker::new(1, 1.0);
            let mut at = Point2::new(0.5, 0.0);
            for (x, y, smallness, radius) in walk {
                at += Vector2::new(x, y) * 0.3_f64.powi(smallness);
                let fresh = fixed.nearest.nearest(at, Nearest::none_within(radius));
                let expected = fresh.is_found().then_some((fresh.index, fresh.distance_sq));
                prop_assert_eq!(tracker.nearest(0, at, &fixed, radius), expected);
            }
        }
    }
}
