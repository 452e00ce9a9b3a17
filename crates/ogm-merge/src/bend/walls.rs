//! Walls as points with a line and a side, and the nearest of them to a place.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Point2, Vector2};
use ogm_core::{CellIndex, ClassThresholds, OccupancyGrid, Se2};

use crate::parallel::map_in_order;

use super::buckets::Buckets;

/// One point stands for the wall in a square of this side, metres, and of a cell at least.
const SPACING_M: f64 = 0.1;
/// The wall around a point is looked at within this, metres, and these spacings at least.
const AROUND_M: f64 = 0.3;
const AROUND: f64 = 2.5;
/// Mean of the directions into free space, each of length 1, from which on a wall has one side.
const SEEN_FROM_ONE_SIDE: f64 = 0.5;
/// A wall is a line where it is at most this wide for its length, as variances.
const LINE: f64 = 0.15;
/// Walls seen from sides that differ by more than this cosine are not the same: 70°.
const SIDE_COSINE: f64 = 0.34;
/// And lines that cross under a larger angle: 45°.
const LINE_COSINE: f64 = 0.7;

/// A point on a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wall {
    pub(super) at: Point2<f64>,
    /// Across the wall; `None` where it is no line.
    pub(super) normal: Option<Vector2<f64>>,
    /// Into the free space in front of it; `None` where both sides are free or none is known.
    pub(super) side: Option<Vector2<f64>>,
}

impl Wall {
    fn turned(&self, turned_from_map: &Se2) -> Self {
        let turned = |direction: Vector2<f64>| *turned_from_map * direction;
        Self { at: self.at, normal: self.normal.map(turned), side: self.side.map(turned) }
    }

    /// Whether `other` may be the same wall.
    fn is_like(&self, other: &Self) -> bool {
        let sides = self.side.zip(other.side).is_none_or(|(a, b)| a.dot(&b) > SIDE_COSINE);
        let lines = self.normal.zip(other.normal);
        sides && lines.is_none_or(|(a, b)| a.dot(&b).abs() > LINE_COSINE)
    }

    /// How far `place` lies off this wall: across it where it is a line.
    pub(super) fn off(&self, place: Point2<f64>) -> Vector2<f64> {
        let away = place - self.at;
        self.normal.map_or(away, |normal| normal * normal.dot(&away))
    }
}

/// The walls of a map.
#[derive(Debug, Clone)]
pub(super) struct Walls {
    pub(super) points: Vec<Wall>,
    /// Metres a cell of the map.
    pub(super) resolution: f64,
    buckets: Buckets,
}

impl Walls {
    /// The walls of `map`, moved by `frame_from_map`.
    pub(super) fn new(
        map: &OccupancyGrid,
        frame_from_map: &Se2,
        thresholds: &ClassThresholds,
    ) -> Self {
        let resolution = map.frame().resolution();
        let spacing = SPACING_M.max(1.01 * resolution);
        let mut faces: BTreeMap<[i64; 2], Face> = BTreeMap::new();
        for (index, cell) in map.cells().indexed() {
            if !thresholds.is_occupied(*cell) {
                continue;
            }
            let Some(free) = free_around(map, index, thresholds) else { continue };
            let cells = Vector2::new(index.column as f64 + 0.5, index.row as f64 + 0.5);
            let face = faces.entry(square(cells * resolution, spacing)).or_default();
            face.place += map.frame().cell_centre(index).coords;
            face.free += map.frame().map_from_grid() * free;
            face.cells += 1.0;
        }
        let bare = faces.into_values().map(|face| {
            let free = face.free / face.cells;
            let side = (free.norm() >= SEEN_FROM_ONE_SIDE).then(|| free.normalize());
            Wall { at: Point2::from(face.place / face.cells), normal: None, side }
        });
        let bare = Self::of(bare.collect(), resolution);
        let points = map_in_order(&bare.points, |wall| {
            let normal = bare.normal_around(wall, AROUND_M.max(AROUND * spacing));
            let facing =
                |side: Vector2<f64>, normal: Vector2<f64>| normal * normal.dot(&side).signum();
            let side = wall.side.map(|side| normal.map_or(side, |normal| facing(side, normal)));
            Wall { normal, side, ..*wall }
        });
        Self::of(points, resolution).moved(frame_from_map)
    }

    pub(super) fn moved(&self, moved_from_frame: &Se2) -> Self {
        let points = self.points.iter().map(|wall| {
            let turned = wall.turned(moved_from_frame);
            Wall { at: *moved_from_frame * wall.at, ..turned }
        });
        Self::of(points.collect(), self.resolution)
    }

    /// All of them together; no walls where there are none.
    pub(super) fn united(all: impl Iterator<Item = Self>) -> Self {
        let (mut points, mut resolution) = (Vec::new(), 0.0_f64);
        for walls in all {
            points.extend(walls.points);
            resolution = resolution.max(walls.resolution);
        }
        Self::of(points, resolution)
    }

    fn of(points: Vec<Wall>, resolution: f64) -> Self {
        let buckets = Buckets::new(points.iter().map(|wall| wall.at));
        Self { points, resolution, buckets }
    }

    /// The nearest wall that may be `wall` if that lies at `place`, turned by `turned_from_map`.
    pub(super) fn nearest(
        &self,
        place: Point2<f64>,
        wall: &Wall,
        turned_from_map: &Se2,
        reach: f64,
    ) -> Option<&Wall> {
        let turned = wall.turned(turned_from_map);
        let is_line = |wall: &Wall| wall.normal.is_some();
        let like = self
            .within(place, reach)
            .filter(|(other, _)| is_line(other) >= is_line(&turned) && turned.is_like(other));
        let nearest = like.reduce(|best, other| if other.1 < best.1 { other } else { best });
        nearest.map(|(wall, _)| wall)
    }

    /// The walls within `reach` of `place`, with their squared distances.
    fn within(&self, place: Point2<f64>, reach: f64) -> impl Iterator<Item = (&Wall, f64)> {
        let walls = self.buckets.around(place, reach).map(|index| &self.points[index]);
        walls
            .map(move |wall| (wall, (wall.at - place).norm_squared()))
            .filter(move |(_, squared)| *squared <= reach * reach)
    }

    fn normal_around(&self, wall: &Wall, reach: f64) -> Option<Vector2<f64>> {
        let (mut sum, mut squares, mut count) = (Vector2::zeros(), Matrix2::zeros(), 0.0);
        for (other, _) in self.within(wall.at, reach).filter(|(other, _)| wall.is_like(other)) {
            let away = other.at - wall.at;
            sum += away;
            squares += away * away.transpose();
            count += 1.0;
        }
        let spread = squares / count - (sum / count) * (sum / count).transpose();
        let axes = spread.symmetric_eigen();
        let small = axes.eigenvalues.imin();
        let is_line = count >= 3.0 && axes.eigenvalues[small] <= LINE * axes.eigenvalues[1 - small];
        is_line.then(|| axes.eigenvectors.column(small).into_owned())
    }
}

/// The cells of a wall that border on free space, within a square.
#[derive(Default)]
struct Face {
    place: Vector2<f64>,
    /// Sum of the directions into the free space.
    free: Vector2<f64>,
    cells: f64,
}

/// The direction from a cell into the free cells around it, zero where they lie on both sides;
/// `None` where none is free.
fn free_around(
    map: &OccupancyGrid,
    at: CellIndex,
    thresholds: &ClassThresholds,
) -> Option<Vector2<f64>> {
    let mut sum = Vector2::zeros();
    let mut any = false;
    for (dx, dy) in [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)] {
        let column = at.column.checked_add_signed(dx);
        let cell = column.zip(at.row.checked_add_signed(dy));
        let cell = cell.and_then(|(column, row)| map.cells().get(CellIndex { column, row }));
        if cell.is_some_and(|cell| thresholds.is_free(*cell)) {
            any = true;
            sum += Vector2::new(dx as f64, dy as f64);
        }
    }
    any.then(|| if sum.norm() < 1.0 { Vector2::zeros() } else { sum.normalize() })
}

/// The square of `side` that holds a place.
#[expect(clippy::cast_possible_truncation, reason = "saturates far from any map")]
pub(super) fn square(place: Vector2<f64>, side: f64) -> [i64; 2] {
    [(place.x / side).floor() as i64, (place.y / side).floor() as i64]
}
