//! In which direction the walls hold an alignment.

use nalgebra::{Matrix2, Point2, Vector2};

use crate::cloud::Cloud;
use crate::pairing::Pair;

/// What the points around a point look like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// A wall with this unit normal.
    Wall(Vector2<f64>),
    /// A point on its own, which holds in every direction.
    Alone,
    /// An area, as inside a thick wall, of which nothing can be said.
    Area,
}

/// Radius in spacings that covers the window of 5 × 5 cells and nothing more.
const WINDOW: f64 = 2.9;
/// A wall is at most this wide for its length, as variances in the window: three cells of five.
const MAX_WALL_RATIO: f64 = 0.5;

/// Windows grow by this while they hold too few points: a scan thins out with the range, and a
/// spacing may be stated too small.
const GROWTH: f64 = 2.0;
/// Times that a window grows.
const GROWTHS: usize = 4;
/// Points, itself among them, that give a shape.
const LEAST: u32 = 3;

/// The points around a point: how many, and their moments about it.
#[derive(Default)]
struct Around {
    count: u32,
    sum: Vector2<f64>,
    squares: Matrix2<f64>,
}

impl Around {
    fn of(point: Point2<f64>, cloud: &Cloud, radius: f64) -> Self {
        let mut around = Self::default();
        cloud.nearest.for_each_within(point, radius, |near| {
            let offset = near - point;
            around.count += 1;
            around.sum += offset;
            around.squares += offset * offset.transpose();
        });
        around
    }
}

/// The shape around each point by total least squares in a window of 5 × 5 spacings, or in a
/// larger one where that holds too few.
pub(crate) fn shapes(cloud: &Cloud) -> Vec<Shape> {
    let shape = |&point: &Point2<f64>| {
        let mut radius = WINDOW * cloud.spacing;
        let mut around = Around::of(point, cloud, radius);
        for _ in 0..GROWTHS {
            if around.count >= LEAST {
                break;
            }
            radius *= GROWTH;
            around = Around::of(point, cloud, radius);
        }
        let Around { count, sum, squares } = around;
        if count < LEAST {
            return Shape::Alone;
        }
        let count = f64::from(count);
        let spread = squares / count - (sum / count) * (sum / count).transpose();
        let axes = Axes::of(&spread);
        if axes.large <= 0.0 {
            Shape::Alone
        } else if axes.small <= MAX_WALL_RATIO * axes.large {
            Shape::Wall(axes.small_direction)
        } else {
            Shape::Area
        }
    };
    cloud.positions.iter().map(shape).collect()
}

/// The direction in which the walls of the pairs say nothing: that of the smaller eigenvalue of
/// Σ n nᵀ if it is below `min_ratio` of the larger.
pub(crate) fn unobservable_direction(
    pairs: &[Pair],
    shapes: &[Shape],
    min_ratio: f64,
) -> Option<Vector2<f64>> {
    let mut sum = Matrix2::zeros();
    for pair in pairs {
        match shapes[pair.target as usize] {
            Shape::Wall(normal) => sum += normal * normal.transpose(),
            Shape::Alone => sum += Matrix2::identity() / 2.0,
            Shape::Area => {}
        }
    }
    let axes = Axes::of(&sum);
    (axes.small < min_ratio * axes.large).then_some(axes.small_direction)
}

/// Eigenvalues of a symmetric matrix.
struct Axes {
    small: f64,
    large: f64,
    /// Unit eigenvector of the smaller one.
    small_direction: Vector2<f64>,
}

impl Axes {
    fn of(matrix: &Matrix2<f64>) -> Self {
        let mean = matrix.trace() / 2.0;
        let half_difference = (matrix.m11 - matrix.m22) / 2.0;
        let radius = half_difference.hypot(matrix.m12);
        let large_angle = matrix.m12.atan2(half_difference) / 2.0;
        let (sin, cos) = large_angle.sin_cos();
        Self {
            small: mean - radius,
            large: mean + radius,
            small_direction: Vector2::new(-sin, cos),
        }
    }
}
