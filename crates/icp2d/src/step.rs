//! The motion that brings given pairs together.

use nalgebra::{Matrix3, Point2, SymmetricEigen, Vector2, Vector3};
use ogm_core::Se2;

use crate::Kernel;
use crate::pairing::Matcher;
use crate::structure::Shape;

/// What weighs a residual.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Weighing {
    pub(crate) kernel: Kernel,
    /// Of the coarser map, metres.
    pub(crate) spacing: f64,
}

impl Weighing {
    fn of(&self, residual: f64) -> f64 {
        self.kernel.weight(residual, self.spacing)
    }
}

/// Weighted means of the two ends of the pairs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Centres {
    pub(crate) target: Point2<f64>,
    pub(crate) source: Point2<f64>,
}

impl Centres {
    pub(crate) fn of(matcher: &Matcher<'_>, weighing: &Weighing) -> Self {
        // Relative to one point, so that maps far from their origin lose no digits.
        let base = |points: &[Point2<f64>]| points.first().copied().unwrap_or_default();
        let target_base = base(&matcher.target.positions);
        let source_base = base(&matcher.source.positions);
        let (mut target, mut source, mut total) = (Vector2::zeros(), Vector2::zeros(), 0.0);
        for pair in &matcher.pairs {
            let weight = weighing.of(pair.distance_sq.sqrt());
            target += weight * (matcher.target.positions[pair.target as usize] - target_base);
            source += weight * (matcher.source.positions[pair.source as usize] - source_base);
            total += weight;
        }
        Self { target: target_base + target / total, source: source_base + source / total }
    }
}

/// The motion with the least sum of weighted squared distances between the points of the pairs.
pub(crate) fn point_to_point(matcher: &Matcher<'_>, centres: &Centres, weighing: &Weighing) -> Se2 {
    let (mut cross, mut dot) = (0.0, 0.0);
    for pair in &matcher.pairs {
        let weight = weighing.of(pair.distance_sq.sqrt());
        let target = matcher.target.positions[pair.target as usize] - centres.target;
        let source = matcher.source.positions[pair.source as usize] - centres.source;
        cross += weight * source.perp(&target);
        dot += weight * source.dot(&target);
    }
    let turn = Se2::new(0.0, 0.0, f64::atan2(cross, dot));
    let shift = centres.target - turn * centres.source;
    Se2::new(shift.x, shift.y, turn.theta())
}

/// One Gauss–Newton step from `target_from_source` on the squared distances to the walls around
/// the target points; directions without information are left alone.
pub(crate) fn point_to_line(
    matcher: &Matcher<'_>,
    shapes: &[Shape],
    centres: &Centres,
    target_from_source: &Se2,
    weighing: &Weighing,
) -> Se2 {
    let normal = NormalEquations::new(matcher, shapes, centres, target_from_source, weighing);
    let solution = solve_where_determined(normal.matrix, &normal.right_side);
    let shift = Vector2::new(solution.x, solution.y);
    Se2::about(normal.centre, solution.z / normal.arm, shift) * *target_from_source
}

/// Covariance of (x, y, θ) of `target_from_source` in target axes, with the variance of a residual
/// taken from the residuals; `None` where a direction is open.
pub(crate) fn covariance(
    matcher: &Matcher<'_>,
    shapes: &[Shape],
    target_from_source: &Se2,
    weighing: &Weighing,
) -> Option<Matrix3<f64>> {
    let centres = Centres::of(matcher, weighing);
    let normal = NormalEquations::new(matcher, shapes, &centres, target_from_source, weighing);
    let inverse = normal.matrix.try_inverse()?;
    let freedom = normal.rows - 3.0;
    if freedom <= 0.0 {
        return None;
    }
    // From a turn about the centre to one about the origin of the target.
    let lever = target_from_source.translation() - normal.centre.coords;
    let [turn, one] = [1.0 / normal.arm, 1.0];
    let origin_from_centre =
        Matrix3::new(one, 0.0, -lever.y * turn, 0.0, one, lever.x * turn, 0.0, 0.0, turn);
    let variance = normal.squares / freedom;
    Some(origin_from_centre * (variance * inverse) * origin_from_centre.transpose())
}

/// Of the distances to walls, in a shift and a turn about the centre whose unit moves the mean
/// source point by one metre.
struct NormalEquations {
    matrix: Matrix3<f64>,
    right_side: Vector3<f64>,
    /// Of the source, in the target frame.
    centre: Point2<f64>,
    arm: f64,
    /// Weighted sum of squared residuals, and of weights.
    squares: f64,
    rows: f64,
}

impl NormalEquations {
    fn new(
        matcher: &Matcher<'_>,
        shapes: &[Shape],
        centres: &Centres,
        target_from_source: &Se2,
        weighing: &Weighing,
    ) -> Self {
        let mut normal = Self {
            matrix: Matrix3::zeros(),
            right_side: Vector3::zeros(),
            centre: *target_from_source * centres.source,
            arm: mean_arm(matcher, centres),
            squares: 0.0,
            rows: 0.0,
        };
        for pair in &matcher.pairs {
            let target = matcher.target.positions[pair.target as usize];
            let source = *target_from_source * matcher.source.positions[pair.source as usize];
            if let Shape::Wall(direction) = shapes[pair.target as usize] {
                normal.add(direction, source, target, weighing);
            } else {
                normal.add(Vector2::x(), source, target, weighing);
                normal.add(Vector2::y(), source, target, weighing);
            }
        }
        normal
    }

    fn add(
        &mut self,
        direction: Vector2<f64>,
        source: Point2<f64>,
        target: Point2<f64>,
        weighing: &Weighing,
    ) {
        let turned = (source - self.centre) / self.arm;
        let row = Vector3::new(direction.x, direction.y, turned.perp(&direction));
        let residual = direction.dot(&(target - source));
        let weight = weighing.of(residual);
        self.matrix += weight * row * row.transpose();
        self.right_side += weight * residual * row;
        self.squares += weight * residual * residual;
        self.rows += weight;
    }
}

/// Mean distance of the source points from their centre, which makes the unknowns comparable.
fn mean_arm(matcher: &Matcher<'_>, centres: &Centres) -> f64 {
    let sum: f64 = matcher
        .pairs
        .iter()
        .map(|pair| (matcher.source.positions[pair.source as usize] - centres.source).norm())
        .sum();
    let arm = sum / matcher.pairs.len() as f64;
    if arm > 0.0 { arm } else { 1.0 }
}

/// The shortest solution of a symmetric system, without what its null space would add.
fn solve_where_determined(matrix: Matrix3<f64>, right_side: &Vector3<f64>) -> Vector3<f64> {
    let eigen = SymmetricEigen::new(matrix);
    let largest = eigen.eigenvalues.max();
    let mut solution = Vector3::zeros();
    for (value, axis) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > 1e-9 * largest {
            solution += axis * (axis.dot(right_side) / value);
        }
    }
    solution
}
