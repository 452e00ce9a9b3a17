//! Refinement of a pose on the distance fields of both maps.

use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use ogm_core::Se2;

use crate::prepare::{PreparedMap, WallPoint};

/// Normal equations of the symmetric problem, about a centre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Normal {
    /// Σ w J Jᵀ over (x, y, θ), turned about [`centre`](Self::centre).
    pub(crate) information: Matrix3<f64>,
    gradient: Vector3<f64>,
    /// Σ w r², square metres.
    pub(crate) residual: f64,
    /// Σ w.
    pub(crate) weight: f64,
    /// In the frame of the first map.
    pub(crate) centre: Point2<f64>,
}

/// Follows the walls of both maps from `first_from_second`, one Gauss–Newton step for each of
/// `scales` (metres at which a distance has lost three quarters of its weight), on at most `most`
/// points of each map.
pub(crate) fn refine(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: Se2,
    scales: &[f64],
    most: usize,
) -> Se2 {
    let mut first_from_second = first_from_second;
    for &scale in scales {
        let normal = normal_equations(first, second, &first_from_second, scale, most);
        let Some(step) = normal.step() else { return first_from_second };
        let limit = (2.0 * scale / step.xy().norm()).min(0.1 / step.z.abs()).min(1.0);
        let step = step * limit;
        first_from_second = Se2::about(normal.centre, step.z, step.xy()) * first_from_second;
    }
    first_from_second
}

/// Residuals are the distances of the walls of each map in the field of the other, weighted after
/// Geman and McClure: w = (σ²/(σ² + d²))².
pub(crate) fn normal_equations(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    scale: f64,
    most: usize,
) -> Normal {
    let centre = *first_from_second * second.centre;
    let mut sums = Sums { scale_sq: scale * scale, ..Sums::default() };
    for &WallPoint { at, .. } in second.walls.iter().take(most) {
        let in_first = *first_from_second * at;
        if let Some(slope) = first.lattice.slope(&first.distance, in_first) {
            sums.add(slope.value, slope.gradient, in_first - centre);
        }
    }
    let second_from_first = first_from_second.inverse();
    for &WallPoint { at, .. } in first.walls.iter().take(most) {
        if let Some(slope) = second.lattice.slope(&second.distance, second_from_first * at) {
            sums.add(slope.value, -(*first_from_second * slope.gradient), at - centre);
        }
    }
    sums.into_normal(centre)
}

impl Normal {
    /// Lightly damped, so that a direction without information stays where it is.
    fn step(&self) -> Option<Vector3<f64>> {
        let mut damped = self.information;
        let translation = damped[(0, 0)].max(damped[(1, 1)]);
        for index in 0..2 {
            damped[(index, index)] += 1e-3 * translation + 1e-9;
        }
        damped[(2, 2)] += 1e-3 * damped[(2, 2)] + 1e-9;
        let step = damped.cholesky()?.solve(&-self.gradient);
        step.iter().all(|part| part.is_finite()).then_some(step)
    }
}

#[derive(Default)]
struct Sums {
    scale_sq: f64,
    /// Upper triangle: xx, xy, yy, xt, yt, tt.
    products: [f64; 6],
    gradient: [f64; 3],
    residual: f64,
    weight: f64,
}

impl Sums {
    #[inline]
    fn add(&mut self, distance: f64, slope: Vector2<f64>, arm: Vector2<f64>) {
        let root = self.scale_sq / (self.scale_sq + distance * distance);
        let weight = root * root;
        let turn = slope.y * arm.x - slope.x * arm.y;
        let (x, y) = (weight * slope.x, weight * slope.y);
        let products =
            [x * slope.x, x * slope.y, y * slope.y, x * turn, y * turn, weight * turn * turn];
        for (sum, product) in self.products.iter_mut().zip(products) {
            *sum += product;
        }
        let pull = weight * distance;
        self.gradient[0] += pull * slope.x;
        self.gradient[1] += pull * slope.y;
        self.gradient[2] += pull * turn;
        self.residual += pull * distance;
        self.weight += weight;
    }

    fn into_normal(self, centre: Point2<f64>) -> Normal {
        let [xx, xy, yy, xt, yt, tt] = self.products;
        Normal {
            information: Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt),
            gradient: Vector3::from(self.gradient),
            residual: self.residual,
            weight: self.weight,
            centre,
        }
    }
}
