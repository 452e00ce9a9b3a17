//! How surely the walls hold a pose.

use nalgebra::{Matrix2, Matrix3, Vector2};
use ogm_core::Se2;

use crate::prepare::PreparedMap;
use crate::refine::{POLISH_POINTS, Points, Sides, normal_equations};
use crate::report::WeakDirection;

/// Metres of wall over which errors of a map are one error: neighbouring points share beams,
/// rasterisation and drift.
const CORRELATED_M: f64 = 0.5;
/// Least standard deviation of a wall's place, cells of the coarser map.
const LEAST_SIGMA_CELLS: f64 = 0.3;
/// A direction is weak if walls hold it this many times less than the best held one.
const WEAK_RATIO: f64 = 12.0;

/// Covariance of (x, y, θ) of `target_from_source`, and the weak direction if there is one, from
/// the normal equations of the refinement at `target_local_from_source_local`.
pub(crate) fn covariance(
    target: &PreparedMap,
    source: &PreparedMap,
    target_local_from_source_local: &Se2,
    scale: f64,
) -> (Matrix3<f64>, Option<WeakDirection>) {
    let points = Points { most: POLISH_POINTS, sides: Sides::Facing };
    let normal = normal_equations(target, source, target_local_from_source_local, scale, points);
    let resolution = target.resolution().max(source.resolution());
    let measured = normal.residual / normal.weight.max(1e-9);
    let variance = measured.max((LEAST_SIGMA_CELLS * resolution).powi(2));
    // Both maps' walls are counted, and each wall point stands for some of one error.
    let repeats = 2.0 * (CORRELATED_M / target.spacing.max(source.spacing)).max(1.0);
    // A pose is never freer than the maps are large.
    let floor = Matrix3::from_diagonal_element(1e-6);
    let walls = [target, source].map(|map| map.walls.len());
    let used: usize = walls.iter().map(|&walls| walls.min(POLISH_POINTS)).sum();
    let stands_for = walls.iter().sum::<usize>() as f64 / used.max(1) as f64;
    let information = normal.information * stands_for / (variance * repeats) + floor;
    let about_centre = information.try_inverse().unwrap_or_else(Matrix3::identity);

    let weak = weak_direction(&about_centre, target);
    let source_origin = source.map_from_local.inverse().translation();
    let arm =
        *target_local_from_source_local * nalgebra::Point2::from(source_origin) - normal.centre;
    let moved = Matrix3::new(1.0, 0.0, -arm.y, 0.0, 1.0, arm.x, 0.0, 0.0, 1.0);
    let (sin, cos) = target.map_from_local.theta().sin_cos();
    let turned = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let jacobian = turned * moved;
    let covariance = jacobian * about_centre * jacobian.transpose();
    (0.5 * (covariance + covariance.transpose()), weak)
}

/// In axes of the target map.
fn weak_direction(about_centre: &Matrix3<f64>, target: &PreparedMap) -> Option<WeakDirection> {
    let translation: Matrix2<f64> = about_centre.fixed_view::<2, 2>(0, 0).into();
    let eigen = translation.symmetric_eigen();
    let (weak, strong) = if eigen.eigenvalues[0] > eigen.eigenvalues[1] { (0, 1) } else { (1, 0) };
    let ratio = eigen.eigenvalues[weak] / eigen.eigenvalues[strong].max(1e-18);
    let axis: Vector2<f64> = eigen.eigenvectors.column(weak).into();
    (ratio > WEAK_RATIO).then(|| WeakDirection {
        direction: target.map_from_local * axis,
        sigma_m: eigen.eigenvalues[weak].max(0.0).sqrt(),
    })
}
