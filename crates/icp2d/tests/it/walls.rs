//! Walls to align.

use icp2d::{Alignment, IcpParams, WallPoint, WallPoints};
use nalgebra::{Point2, Vector2};
use ogm_core::{Length, Outcome, Se2};

/// The defaults as they are on a map of 0.02 m a cell, for maps of 1 m a cell.
pub(crate) fn in_cells() -> IcpParams {
    IcpParams {
        section_margin: Length::cells(25.0),
        initial_correspondence_distance: Length::cells(25.0),
        max_correspondence_distance: Length::cells(5.0),
        reciprocity: Length::cells(1.5),
        translation_epsilon: Length::cells(0.002),
        max_translation: Length::cells(50.0),
        ..IcpParams::default()
    }
}

/// Points at whole steps of 1 from `from` to `to`, both included.
pub(crate) fn wall(
    from: [i32; 2],
    to: [i32; 2],
    free_side: Option<Vector2<f64>>,
) -> Vec<WallPoint> {
    let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
    let direction = [(to[0] - from[0]).signum(), (to[1] - from[1]).signum()];
    let at = |axis: usize, step: i32| f64::from(from[axis] + step * direction[axis]);
    (0..=steps)
        .map(|step| WallPoint { position: Point2::new(at(0, step), at(1, step)), free_side })
        .collect()
}

/// The four walls of a room from the origin to (`width`, `height`), seen from inside.
pub(crate) fn room(width: i32, height: i32) -> Vec<WallPoint> {
    [
        wall([0, 0], [width, 0], Some(Vector2::y())),
        wall([0, height], [width, height], Some(-Vector2::y())),
        wall([0, 1], [0, height - 1], Some(Vector2::x())),
        wall([width, 1], [width, height - 1], Some(-Vector2::x())),
    ]
    .concat()
}

/// A floor of 200 × 160 with three inner walls, seen from the right; the points stand irregularly
/// along the walls, as no two scans hit the same spots.
pub(crate) fn floor() -> Vec<WallPoint> {
    let side = Some(Vector2::x());
    let on_lattice = [
        room(200, 160),
        wall([60, 1], [60, 110], side),
        wall([130, 50], [130, 159], side),
        wall([90, 30], [90, 130], side),
    ]
    .concat();
    let shifted = (0_u32..).zip(on_lattice).map(|(index, point)| {
        let along = 0.4 * f64::sin(12.9 * f64::from(index));
        let normal = point.free_side.unwrap();
        WallPoint { position: point.position + Vector2::new(-normal.y, normal.x) * along, ..point }
    });
    shifted.collect()
}

pub(crate) fn set(points: Vec<WallPoint>) -> WallPoints {
    WallPoints::from_points(points, 1.0).unwrap()
}

pub(crate) fn moved(points: &[WallPoint], motion: Se2) -> Vec<WallPoint> {
    let moved = points.iter().map(|point| WallPoint {
        position: motion * point.position,
        free_side: point.free_side.map(|side| motion * side),
    });
    moved.collect()
}

pub(crate) fn found(outcome: Outcome<Alignment>) -> Alignment {
    outcome.into_result().unwrap()
}

/// How far apart two motions put the points of a floor, at most.
pub(crate) fn distance(a: Se2, b: Se2) -> f64 {
    [[0.0, 0.0], [200.0, 0.0], [0.0, 160.0], [200.0, 160.0]]
        .map(|[x, y]| (a * Point2::new(x, y) - b * Point2::new(x, y)).norm())
        .into_iter()
        .fold(0.0, f64::max)
}
