//! How surely the walls hold a pose.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use ogm_core::Se2;

use crate::prepare::PreparedMap;
use crate::refine::{Normal, POLISH_POINTS, Points, Sides, clustered_equations};
use crate::report::{Bend, WeakDirection};

/// Side of the squares over which errors of a map are one error, metres: neighbouring points share
/// beams, rasterisation and drift.
const CLUSTER_M: f64 = 4.0;
/// Standard deviation of a wall's place by rasterisation alone, cells of the coarser map, common to
/// the walls of half a metre.
const RASTER_CELLS: f64 = 0.3;
const RASTER_M: f64 = 0.5;
/// Parts of maps that are not bent move so far by rasterisation, cells of the coarser map.
const BEND_CELLS: f64 = 0.4;
/// How much more than its parts show a bent map leaves open: walls hold a part across them only.
const BEND_HIDDEN: f64 = 2.0;
/// Squares below which their spread says too little to be taken alone.
const FEW_CLUSTERS: f64 = 3.0;
/// A direction is weak if walls hold it this many times less than the best held one.
const WEAK_RATIO: f64 = 12.0;

/// Covariance of (x, y, θ) of `target_from_source`, and the weak direction if there is one.
///
/// The cluster-robust estimate H⁻¹ (Σ g gᵀ) H⁻¹ of White, *Maximum likelihood estimation of
/// misspecified models* (1982), over squares of the map: where maps are bent, each square pulls its
/// own way, and their spread says how far the pose may be off. Added is what cells hide.
pub(crate) fn covariance(
    target: &PreparedMap,
    source: &PreparedMap,
    target_local_from_source_local: &Se2,
    clusters: &[Normal],
    bend: &Bend,
) -> (Matrix3<f64>, Option<WeakDirection>) {
    let pose = target_local_from_source_local;
    let centre = clusters.first().map_or(*pose * source.centre, |cluster| cluster.centre);
    let bread: Matrix3<f64> = clusters.iter().map(|cluster| cluster.information).sum();
    let filling: Matrix3<f64> =
        clusters.iter().map(|cluster| cluster.gradient * cluster.gradient.transpose()).sum();
    let count = clusters.len() as f64;
    // Small samples scatter less about their own mean than about the truth.
    let correction = count / (count - FEW_CLUSTERS).max(1.0);
    // A pose is never freer than the maps are large.
    let floor = Matrix3::from_diagonal_element(1e-6);
    let inverse = (bread + floor).try_inverse().unwrap_or_else(Matrix3::identity);
    let resolution = target.resolution().max(source.resolution());
    // Both maps' walls are counted, and each wall point stands for some of one error.
    let repeats = 2.0 * (RASTER_M / target.spacing.max(source.spacing)).max(1.0);
    let raster = inverse * ((RASTER_CELLS * resolution).powi(2) * repeats);
    let about_centre =
        inverse * filling * inverse * correction + raster + bent(bend, source, resolution);

    let weak = weak_direction(&about_centre, target);
    let source_origin = source.map_from_local.inverse().translation();
    let arm = *target_local_from_source_local * nalgebra::Point2::from(source_origin) - centre;
    let moved = Matrix3::new(1.0, 0.0, -arm.y, 0.0, 1.0, arm.x, 0.0, 0.0, 1.0);
    let (sin, cos) = target.map_from_local.theta().sin_cos();
    let turned = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let jacobian = turned * moved;
    let covariance = jacobian * about_centre * jacobian.transpose();
    (0.5 * (covariance + covariance.transpose()), weak)
}

/// What the walls of each square say of a pose, at a `scale` in metres.
pub(crate) fn clusters(
    target: &PreparedMap,
    source: &PreparedMap,
    target_local_from_source_local: &Se2,
    scale: f64,
) -> Vec<Normal> {
    let points = Points { most: POLISH_POINTS, sides: Sides::Facing };
    let pose = target_local_from_source_local;
    clustered_equations(target, source, pose, scale, points, CLUSTER_M)
}

/// What bent maps leave open: their parts do not agree on one pose, and the one that is found need
/// not be their mean.
fn bent(bend: &Bend, source: &PreparedMap, resolution: f64) -> Matrix3<f64> {
    let shown = bend.rms_m.powi(2) - (BEND_CELLS * resolution).powi(2);
    let variance = BEND_HIDDEN * shown.max(0.0);
    let middle = source.map_from_local * source.centre;
    let weight: f64 = bend.patches.iter().map(|patch| patch.hit_m).sum();
    let spread: f64 =
        bend.patches.iter().map(|patch| patch.hit_m * (patch.at - middle).norm_squared()).sum();
    let radius_sq = (spread / weight.max(1e-9)).max(1.0);
    Matrix3::from_diagonal(&Vector3::new(variance, variance, variance / radius_sq))
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
