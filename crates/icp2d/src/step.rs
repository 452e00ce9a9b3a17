//! The motion that brings given pairs together.

use nalgebra::{Matrix3, Point2, SymmetricEigen, Vector2, Vector3};
use ogm_core::Se2;

use crate::pairing::Matcher;
use crate::structure::Shape;

/// Means of the two ends of the pairs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Centres {
    pub(crate) target: Point2<f64>,
    pub(crate) source: Point2<f64>,
}

impl Centres {
    pub(crate) fn of(matcher: &Matcher<'_>) -> Self {
        // Relative to one point, so that maps far from their origin lose no digits.
        let base = |points: &[Point2<f64>]| points.first().copied().unwrap_or_default();
        let target_base = base(&matcher.target.positions);
        let source_base = base(&matcher.source.positions);
        let (mut target, mut source) = (Vector2::zeros(), Vector2::zeros());
        for pair in &matcher.pairs {
            target += matcher.target.positions[pair.target as usize] - target_base;
            source += matcher.source.positions[pair.source as usize] - source_base;
        }
        let count = matcher.pairs.len() as f64;
        Self { target: target_base + target / count, source: source_base + source / count }
    }
}

/// The motion with the least sum of squared distances between the points of the pairs.
pub(crate) fn point_to_point(matcher: &Matcher<'_>, centres: &Centres) -> Se2 {
    let (mut cross, mut dot) = (0.0, 0.0);
    for pair in &matcher.pairs {
        let target = matcher.target.positions[pair.target as usize] - centres.target;
        let source = matcher.source.positions[pair.source as usize] - centres.source;
        cross += source.perp(&target);
        dot += source.dot(&target);
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
) -> Se2 {
    let centre = *target_from_source * centres.source;
    let arm = mean_arm(matcher, centres);
    let mut normal_matrix = Matrix3::zeros();
    let mut right_side = Vector3::zeros();
    let mut add = |normal: Vector2<f64>, source: Point2<f64>, target: Point2<f64>| {
        let turned = (source - centre) / arm;
        let row = Vector3::new(normal.x, normal.y, turned.perp(&normal));
        normal_matrix += row * row.transpose();
        right_side += row * normal.dot(&(target - source));
    };
    for pair in &matcher.pairs {
        let target = matcher.target.positions[pair.target as usize];
        let source = *target_from_source * matcher.source.positions[pair.source as usize];
        if let Shape::Wall(normal) = shapes[pair.target as usize] {
            add(normal, source, target);
        } else {
            add(Vector2::x(), source, target);
            add(Vector2::y(), source, target);
        }
    }
    let solution = solve_where_determined(normal_matrix, &right_side);
    let shift = Vector2::new(solution.x, solution.y);
    Se2::about(centre, solution.z / arm, shift) * *target_from_source
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
