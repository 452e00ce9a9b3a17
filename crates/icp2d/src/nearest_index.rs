//! The nearest point of a fixed set, exactly.

use nalgebra::Point2;

use crate::buckets::Buckets;
use crate::hierarchy::Hierarchy;
use crate::nearest::Nearest;

/// An index over points. Both kinds give the same answers to the last bit.
#[derive(Debug)]
pub(crate) enum NearestIndex {
    /// For points as dense as cells on walls: several times faster.
    Buckets(Buckets),
    /// For points of any density.
    Hierarchy(Hierarchy),
}

impl NearestIndex {
    /// An index over `points`, of which neighbours should lie about `spacing` apart.
    pub(crate) fn new(points: &[Point2<f64>], spacing: f64) -> Self {
        Buckets::new(points, spacing)
            .map_or_else(|| Self::Hierarchy(Hierarchy::new(points)), Self::Buckets)
    }

    /// The nearest of all points, starting from `best`, which makes it fast and changes only how
    /// far the distance to the others is followed.
    pub(crate) fn nearest(&self, query: Point2<f64>, best: Nearest) -> Nearest {
        match self {
            Self::Buckets(buckets) => buckets.nearest(query, best),
            Self::Hierarchy(hierarchy) => hierarchy.nearest(query, best),
        }
    }

    /// Calls `visit` with each point at most `radius` away, in an order of its own.
    pub(crate) fn for_each_within(
        &self,
        centre: Point2<f64>,
        radius: f64,
        visit: impl FnMut(Point2<f64>),
    ) {
        match self {
            Self::Buckets(buckets) => buckets.for_each_within(centre, radius, visit),
            Self::Hierarchy(hierarchy) => hierarchy.for_each_within(centre, radius, visit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::NearestIndex;
    use crate::buckets::Buckets;
    use crate::hierarchy::Hierarchy;
    use crate::nearest::Nearest;
    use nalgebra::{Point2, distance_squared};
    use proptest::prelude::{Strategy, any, prop, prop_assert_eq, proptest};

    /// Half of the sets lie on a lattice, where ties are common, the other half anywhere.
    fn points() -> impl Strategy<Value = Vec<Point2<f64>>> {
        let coordinate = -20.0_f64..20.0;
        let set = prop::collection::vec((coordinate.clone(), coordinate), 1..80);
        (set, any::<bool>()).prop_map(|(set, on_lattice)| {
            let snap = |x: f64| if on_lattice { x.round() } else { x };
            set.iter().map(|&(x, y)| Point2::new(snap(x), snap(y))).collect()
        })
    }

    fn brute_force(points: &[Point2<f64>], query: Point2<f64>, mut best: Nearest) -> Nearest {
        for (index, point) in (0..).zip(points) {
            best.improve(index, distance_squared(point, &query));
        }
        best
    }

    proptest! {
        #[test]
        fn both_indices_equal_brute_force_with_any_hint(
            points in points(), x in -60_i32..60, y in -60_i32..60, fraction in 0.0_f64..1.0,
            radius in 0.0_f64..50.0, hint in any::<prop::sample::Index>(), offset in -1e6_f64..1e6,
        ) {
            // Whole coordinates tie with lattice points; a hint must not change who wins.
            let shift = offset.round();
            let points: Vec<_> = points.iter().map(|p| Point2::new(p.x + shift, p.y)).collect();
            let indices = [
                NearestIndex::Buckets(Buckets::new(&points, 1.0).unwrap()),
                NearestIndex::Hierarchy(Hierarchy::new(&points)),
            ];
            for part in [0.0, fraction] {
                let query = Point2::new(f64::from(x) / 2.0 + shift + part, f64::from(y) / 2.0);
                let hint = hint.index(points.len());
                let hint_sq = distance_squared(&points[hint], &query);
                let starts = [
                    Nearest::none_within(radius),
                    Nearest::none_within(f64::INFINITY),
                    Nearest::hint(u32::try_from(hint).unwrap(), hint_sq, radius / 10.0),
                ];
                for start in starts {
                    let expected = brute_force(&points, query, start);
                    for index in &indices {
                        prop_assert_eq!(index.nearest(query, start), expected);
                    }
                }
                let within = points.iter().filter(|p| distance_squared(*p, &query) <= radius * radius).count();
                for index in &indices {
                    let mut count = 0;
                    index.for_each_within(query, radius, |_| count += 1);
                    prop_assert_eq!(count, within);
                }
            }
        }

        #[test]
        fn no_other_point_is_nearer_than_stated(points in points(), x in -30.0_f64..30.0, radius in 0.0_f64..50.0) {
            let query = Point2::new(x, -x);
            let mut sorted: Vec<f64> = points.iter().map(|p| distance_squared(p, &query)).collect();
            sorted.sort_by(f64::total_cmp);
            let second = sorted.get(1).copied().unwrap_or(f64::INFINITY);
            let found = NearestIndex::new(&points, 1.0).nearest(query, Nearest::none_within(radius));
            prop_assert_eq!(found.is_found(), sorted[0] <= radius * radius);
            prop_assert_eq!(found.others_sq, second.min(radius * radius));
        }
    }

    #[test]
    fn points_that_no_lattice_explains_go_to_the_hierarchy() {
        let heap = vec![Point2::new(1.0, 2.0); 2000];
        let far_apart: Vec<_> = (0..100).map(|i| Point2::new(f64::from(i) * 1e7, 0.0)).collect();
        for points in [heap, far_apart] {
            let index = NearestIndex::new(&points, 0.05);
            assert!(matches!(index, NearestIndex::Hierarchy(_)));
            let found = index.nearest(points[0], Nearest::none_within(1.0));
            assert_eq!((found.index, found.distance_sq), (0, 0.0));
        }
        let wall: Vec<_> = (0..200).map(|i| Point2::new(f64::from(i) * 0.05, 0.0)).collect();
        assert!(matches!(NearestIndex::new(&wall, 0.05), NearestIndex::Buckets(_)));
    }

    #[test]
    fn an_index_over_nothing_finds_nothing() {
        let index = NearestIndex::new(&[], 1.0);
        let found = index.nearest(Point2::origin(), Nearest::none_within(f64::INFINITY));
        assert!(!found.is_found());
        index.for_each_within(Point2::origin(), 1.0, |point| panic!("found {point}"));
    }
}
