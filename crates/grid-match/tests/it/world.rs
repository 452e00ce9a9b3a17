//! A building drawn exactly: maps of any part, in any frame, with known truth.

use grid_match::{Hypothesis, MatchParams, MatchReport, match_maps};
use nalgebra::{Point2, Vector2};
use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2, wrap_angle};

/// A wall from one point to another, half its thickness to each side.
pub(crate) type Wall = [f64; 4];

const HALF_THICKNESS: f64 = 0.08;

/// Rooms of different sizes with doors, a slanted wall, no symmetry; 12 × 9 m.
pub(crate) const OFFICE: &[Wall] = &[
    [0.0, 0.0, 12.0, 0.0],
    [12.0, 0.0, 12.0, 9.0],
    [12.0, 9.0, 0.0, 9.0],
    [0.0, 9.0, 0.0, 0.0],
    [0.0, 4.0, 1.5, 4.0],
    [2.5, 4.0, 6.0, 4.0],
    [7.0, 4.0, 9.5, 4.0],
    [4.0, 0.0, 4.0, 4.0],
    [5.0, 5.5, 5.0, 9.0],
    [9.5, 0.0, 9.5, 4.0],
    [9.0, 6.0, 12.0, 7.5],
    [7.0, 1.5, 7.8, 1.5],
    [1.2, 6.5, 2.0, 6.5],
    [2.0, 6.5, 2.0, 7.7],
];

/// Another floor of the same size.
pub(crate) const WORKSHOP: &[Wall] = &[
    [0.0, 0.0, 12.0, 0.0],
    [12.0, 0.0, 12.0, 9.0],
    [12.0, 9.0, 0.0, 9.0],
    [0.0, 9.0, 0.0, 0.0],
    [3.0, 0.0, 3.0, 2.0],
    [3.0, 3.0, 3.0, 7.0],
    [3.0, 7.0, 8.0, 7.0],
    [7.5, 2.5, 12.0, 2.5],
    [5.0, 3.5, 6.2, 4.7],
    [9.5, 5.0, 10.7, 5.0],
    [9.5, 5.0, 9.5, 6.0],
];

/// An empty room, its own image after half a turn.
pub(crate) const ROOM: &[Wall] =
    &[[0.0, 0.0, 8.0, 0.0], [8.0, 0.0, 8.0, 5.0], [8.0, 5.0, 0.0, 5.0], [0.0, 5.0, 0.0, 0.0]];

/// Two long walls and nothing else.
pub(crate) const CORRIDOR: &[Wall] = &[[-9.0, 0.0, 30.0, 0.0], [-9.0, 2.0, 30.0, 2.0]];

/// What a map shows of the world: low and high corner, metres.
pub(crate) type View = [f64; 4];

/// The map of `walls` within `view`, in cells of `resolution` along the axes of a frame whose pose
/// in the world is `world_from_map`; the image starts at any whole cell of that frame.
pub(crate) fn draw(
    walls: &[Wall],
    view: View,
    resolution: f64,
    world_from_map: Se2,
) -> OccupancyGrid {
    let map_from_world = world_from_map.inverse();
    let [left, bottom, right, top] = view;
    let corners = [(left, bottom), (right, bottom), (left, top), (right, top)]
        .map(|(x, y)| map_from_world * Point2::new(x, y));
    let low = corners.iter().fold(corners[0], |low, corner| low.inf(corner)) / resolution;
    let high = corners.iter().fold(corners[0], |high, corner| high.sup(corner)) / resolution;
    let corner = Vector2::new(low.x.floor(), low.y.floor()) * resolution;
    let frame = GridFrame::new(resolution, Se2::new(corner.x, corner.y, 0.0)).unwrap();
    let size = [high.x.ceil() - low.x.floor(), high.y.ceil() - low.y.floor()].map(count);
    let mut cells = Grid::filled(size[0], size[1], Occupancy::UNKNOWN).unwrap();
    for index in 0..size[0] * size[1] {
        let at = world_from_map * frame.cell_centre(cells.index_of(index));
        if at.x > left && at.x < right && at.y > bottom && at.y < top {
            let in_wall = walls.iter().any(|wall| distance(at, wall) < HALF_THICKNESS);
            cells.cells_mut()[index] = if in_wall { Occupancy::OCCUPIED } else { Occupancy::FREE };
        }
    }
    OccupancyGrid::new(frame, cells)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size of cells")]
fn count(cells: f64) -> usize {
    cells as usize
}

fn distance(at: Point2<f64>, &[x0, y0, x1, y1]: &Wall) -> f64 {
    let (start, end) = (Point2::new(x0, y0), Point2::new(x1, y1));
    let along = end - start;
    let share = ((at - start).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (start + along * share - at).norm()
}

/// The left two thirds of a 12 × 9 m building, at 0.1 m.
pub(crate) fn left_part(walls: &[Wall], world_from_map: Se2) -> OccupancyGrid {
    draw(walls, [-0.2, -0.2, 8.3, 9.2], 0.1, world_from_map)
}

/// The right two thirds of a 12 × 9 m building, at 0.1 m.
pub(crate) fn right_part(walls: &[Wall], world_from_map: Se2) -> OccupancyGrid {
    draw(walls, [3.2, -0.2, 12.2, 9.2], 0.1, world_from_map)
}

pub(crate) fn matched(target: &OccupancyGrid, source: &OccupancyGrid) -> MatchReport {
    match_maps(target, source, &MatchParams::default(), &()).unwrap()
}

pub(crate) fn found(target: &OccupancyGrid, source: &OccupancyGrid) -> Se2 {
    let report = matched(target, source);
    assert!(report.outcome.refusal().is_none(), "{:?}", report.outcome);
    report.hypotheses[0].pose.target_from_source
}

/// How far two poses put the middle of the building apart, metres, and by how much they turn it
/// differently, radians.
pub(crate) fn apart(
    a_target_from_source: Se2,
    b_target_from_source: Se2,
    world_from_source: Se2,
) -> (f64, f64) {
    let middle = world_from_source.inverse() * Point2::new(6.0, 4.5);
    let shift = (a_target_from_source * middle - b_target_from_source * middle).norm();
    (shift, wrap_angle(a_target_from_source.theta() - b_target_from_source.theta()).abs())
}

/// Whether one of `hypotheses` is within 0.2 m and 2° of `target_from_source`.
pub(crate) fn among(
    hypotheses: &[Hypothesis],
    target_from_source: Se2,
    world_from_source: Se2,
) -> bool {
    hypotheses.iter().any(|hypothesis| {
        let pose = hypothesis.pose.target_from_source;
        let (shift, turn) = apart(pose, target_from_source, world_from_source);
        shift < 0.2 && turn < 2.0_f64.to_radians()
    })
}
