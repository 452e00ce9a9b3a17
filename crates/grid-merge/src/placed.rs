//! A map, where it lies, and how sure that is at each place.

use std::cmp::Ordering;

use nalgebra::{Matrix3, Point2};
use ogm_core::{OccupancyGrid, Se2};

/// A map and where it lies.
#[derive(Debug, Clone, Copy)]
pub struct PlacedMap<'a> {
    /// The map, in its own map frame.
    pub map: &'a OccupancyGrid,
    /// Its pose in the frame of the output.
    pub reference_from_map: Se2,
    /// Covariance of (x, y, θ) of that pose, in the axes of the output, m², m·rad, rad²; zero for
    /// the map that the others lie on, `None` where nobody knows.
    pub covariance: Option<Matrix3<f64>>,
    /// How far its parts may lie from where the pose puts them because the map itself is bent, one
    /// standard deviation, metres.
    pub bend_m: f64,
}

impl<'a> PlacedMap<'a> {
    /// A rigid map of whose pose no uncertainty is known.
    #[must_use]
    pub fn new(map: &'a OccupancyGrid, reference_from_map: Se2) -> Self {
        Self { map, reference_from_map, covariance: None, bend_m: 0.0 }
    }

    /// Standard deviation of where the pose puts `place`, a point of the output, along the axis in
    /// which it is largest, metres; zero where nobody knows.
    ///
    /// To first order a point p moves by (dx, dy) + dθ × (p − t) when the pose moves.
    pub(crate) fn sigma_at(&self, place: Point2<f64>) -> f64 {
        let Some(covariance) = self.covariance else {
            return 0.0;
        };
        let arm = place.coords - self.reference_from_map.translation();
        let c = |row: usize, column: usize| covariance[(row, column)];
        let xx = c(0, 0) - 2.0 * arm.y * c(0, 2) + arm.y * arm.y * c(2, 2);
        let yy = c(1, 1) + 2.0 * arm.x * c(1, 2) + arm.x * arm.x * c(2, 2);
        let xy = c(0, 1) + arm.x * c(0, 2) - arm.y * c(1, 2) - arm.x * arm.y * c(2, 2);
        let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
        largest.max(0.0).sqrt()
    }

    /// The surer of two maps first: less uncertain in its middle, finer, and, so that the order in
    /// which they are handed in decides nothing, by their poses.
    fn by_sureness(&self, other: &Self) -> Ordering {
        let unsure = |placed: &Self| match placed.covariance {
            Some(_) => placed.sigma_at(placed.middle()) + placed.bend_m,
            None => f64::INFINITY,
        };
        let resolution = |placed: &Self| placed.map.frame().resolution();
        let pose = |placed: &Self| {
            let pose = placed.reference_from_map;
            [pose.x(), pose.y(), pose.theta()]
        };
        let poses = pose(self).into_iter().zip(pose(other));
        unsure(self)
            .total_cmp(&unsure(other))
            .then(resolution(self).total_cmp(&resolution(other)))
            .then(poses.fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(&b))))
    }

    fn middle(&self) -> Point2<f64> {
        let half = |cells: usize| 0.5 * cells as f64;
        let middle = Point2::new(half(self.map.width()), half(self.map.height()));
        self.reference_from_map * self.map.frame().point_from_cells(middle)
    }

    /// Largest standard deviation of a place of the map: it is convex, so it is at a corner.
    pub(crate) fn largest_sigma(&self) -> f64 {
        let (width, height) = (self.map.width() as f64, self.map.height() as f64);
        let corners = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
        let sigmas = corners.map(|(column, row)| {
            let corner = self.map.frame().point_from_cells(Point2::new(column, row));
            self.sigma_at(self.reference_from_map * corner)
        });
        sigmas.into_iter().fold(0.0, f64::max)
    }
}

/// The maps by their place in `maps`, surest first; the first map, which gives the output its
/// lattice, before all that are not surer.
pub(crate) fn surest_first(maps: &[PlacedMap<'_>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..maps.len()).collect();
    let is_reference = |map: usize| map == 0 && maps[0].covariance.is_none_or(|c| c.norm() == 0.0);
    order.sort_by(|&a, &b| {
        is_reference(b).cmp(&is_reference(a)).then_with(|| maps[a].by_sureness(&maps[b]))
    });
    order
}

#[cfg(test)]
mod tests {
    use super::{PlacedMap, surest_first};
    use nalgebra::{Matrix3, Point2};
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    fn map(resolution: f64) -> OccupancyGrid {
        let frame = GridFrame::new(resolution, Se2::identity()).unwrap();
        OccupancyGrid::from_ascii(frame, "#.\n..").unwrap()
    }

    #[test]
    fn an_unsure_heading_moves_far_places_more_than_near_ones() {
        let map = map(0.05);
        let covariance = Some(Matrix3::from_diagonal_element(1.0).map_with_location(
            |row, _, one| {
                if row == 2 { 1e-4 * one } else { 4e-4 * one }
            },
        ));
        let placed = PlacedMap { covariance, ..PlacedMap::new(&map, Se2::new(3.0, -1.0, 0.7)) };
        let here = placed.sigma_at(Point2::new(3.0, -1.0));
        let there = placed.sigma_at(Point2::new(3.0, 9.0));
        assert!((here - 0.02).abs() < 1e-12, "{here}");
        assert!((there - (4e-4_f64 + 1e-4 * 100.0).sqrt()).abs() < 1e-12, "{there}");
    }

    #[test]
    fn the_reference_is_surest_and_the_rest_goes_by_sigma_then_resolution() {
        let (coarse, fine) = (map(0.1), map(0.05));
        let with = |map, sigma: f64| PlacedMap {
            covariance: Some(Matrix3::from_diagonal_element(sigma * sigma)),
            ..PlacedMap::new(map, Se2::identity())
        };
        let unknown = PlacedMap::new(&fine, Se2::identity());
        let maps = [
            with(&coarse, 0.0),
            unknown,
            with(&coarse, 0.02),
            with(&fine, 0.02),
            with(&fine, 0.01),
        ];
        assert_eq!(surest_first(&maps), [0, 4, 3, 2, 1]);
        let bent = PlacedMap { bend_m: 0.1, ..maps[4] };
        assert_eq!(surest_first(&[maps[0], bent, maps[2]]), [0, 2, 1]);
    }
}
