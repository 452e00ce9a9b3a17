//! A floor plan: solid things on a floor, and where two robots go.

use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, Grid, GridFrame, RobotId, Se2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::SimError;

/// The first robot of a team; of a pair the one whose map frame is kept.
pub const TARGET: RobotId = RobotId(0);
/// The second robot of a team; of a pair the one whose map is to be moved.
pub const SOURCE: RobotId = RobotId(1);

/// One visible side of a solid; the solid lies to the left of `start` → `end`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// One end, metres in the plan.
    pub start: Point2<f64>,
    /// The other end, metres in the plan.
    pub end: Point2<f64>,
}

impl Face {
    /// Metres from `point` to the nearest point of the face.
    #[must_use]
    pub fn distance(&self, point: Point2<f64>) -> f64 {
        let along = self.end - self.start;
        let share = (point - self.start).dot(&along) / along.norm_squared();
        (self.start + along * share.clamp(0.0, 1.0) - point).norm()
    }

    /// Metres from one end to the other.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }

    /// The unit vector that points away from the solid.
    pub(crate) fn outward(&self) -> Vector2<f64> {
        let along = (self.end - self.start).normalize();
        Vector2::new(along.y, -along.x)
    }
}

/// What a solid is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Wall,
    Furniture,
}

/// A rectangle that stands in the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Solid {
    kind: Kind,
    centre: Point2<f64>,
    half: Vector2<f64>,
    /// Unit vector of its own x axis.
    along: Vector2<f64>,
}

impl Solid {
    /// A rectangle of `size` about `centre`, turned by `angle` radians.
    pub(crate) fn new(kind: Kind, centre: Point2<f64>, size: Vector2<f64>, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { kind, centre, half: size / 2.0, along: Vector2::new(cos, sin) }
    }

    /// The same with x and y swapped.
    pub(crate) fn transposed(&self) -> Self {
        Self {
            centre: Point2::new(self.centre.y, self.centre.x),
            half: self.half.yx(),
            along: Vector2::new(self.along.x, -self.along.y),
            ..*self
        }
    }

    /// The same after half a turn of a plan of `size` about its middle.
    pub(crate) fn half_turned(&self, size: Vector2<f64>) -> Self {
        Self { centre: Point2::from(size - self.centre.coords), along: -self.along, ..*self }
    }

    /// Counter-clockwise.
    fn corners(&self) -> [Point2<f64>; 4] {
        let x = self.along * self.half.x;
        let y = Vector2::new(-self.along.y, self.along.x) * self.half.y;
        [-x - y, x - y, x + y, y - x].map(|offset| self.centre + offset)
    }

    fn faces(&self) -> impl Iterator<Item = Face> {
        let [a, b, c, d] = self.corners();
        [(a, b), (b, c), (c, d), (d, a)].into_iter().map(|(start, end)| Face { start, end })
    }

    /// Metres from `point` to the outline, below 0 inside.
    fn signed_distance(&self, point: Point2<f64>) -> f64 {
        let (dx, dy) = (point.x - self.centre.x, point.y - self.centre.y);
        let x = (self.along.x * dx + self.along.y * dy).abs() - self.half.x;
        let y = (self.along.x * dy - self.along.y * dx).abs() - self.half.y;
        if x > 0.0 && y > 0.0 { x.hypot(y) } else { x.max(y) }
    }
}

/// Solid things on a floor, and the way points of two robots.
///
/// Walls are rectangles of their thickness, so that a robot sees the face on its own side only.
/// The plan frame has its origin at the lower-left corner; lengths are metres.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorPlan {
    size: Vector2<f64>,
    solids: Vec<Solid>,
    target_route: Vec<Point2<f64>>,
    source_route: Vec<Point2<f64>>,
}

impl FloorPlan {
    pub(crate) fn new(
        size: Vector2<f64>,
        solids: Vec<Solid>,
        target_route: Vec<Point2<f64>>,
        source_route: Vec<Point2<f64>>,
    ) -> Self {
        Self { size, solids, target_route, source_route }
    }

    /// Seven rooms along a corridor, 14 × 12 m, in the proportions of the test building of
    /// Tsardoulias et al., *Metric Map Merging using RFID Tags & Topological Information*.
    #[must_use]
    #[expect(clippy::missing_panics_doc, reason = "a test parses the embedded text")]
    pub fn plan_a() -> Self {
        Self::parse(include_str!("../plans/plan_a.txt")).expect("the embedded plan is valid")
    }

    /// Seven rooms with alcoves, 17 × 10 m, for matching wall segments as in Saeedi et al.,
    /// *Multiple robot simultaneous localization and mapping*.
    #[must_use]
    #[expect(clippy::missing_panics_doc, reason = "a test parses the embedded text")]
    pub fn plan_b() -> Self {
        Self::parse(include_str!("../plans/plan_b.txt")).expect("the embedded plan is valid")
    }

    /// Width and height of the plan's frame, metres.
    #[must_use]
    pub fn size(&self) -> Vector2<f64> {
        self.size
    }

    /// The way points of a robot, at least two; none but the first two have a route of the plan.
    #[must_use]
    pub fn route(&self, robot: RobotId) -> Option<&[Point2<f64>]> {
        match robot {
            TARGET => Some(&self.target_route),
            SOURCE => Some(&self.source_route),
            _ => None,
        }
    }

    /// The same floor with other routes.
    pub(crate) fn with_routes(self, target: Vec<Point2<f64>>, source: Vec<Point2<f64>>) -> Self {
        Self { target_route: target, source_route: source, ..self }
    }

    /// The same floor with a share of its furniture carried elsewhere nearby, or away.
    pub(crate) fn with_furniture_moved(&self, share: f64, rng: &mut ChaCha8Rng) -> Self {
        let mut moved = self.clone();
        moved.solids.clear();
        for &solid in &self.solids {
            if solid.kind == Kind::Wall || !rng.random_bool(share) {
                moved.solids.push(solid);
            } else if rng.random_bool(0.7) {
                let step = Vector2::new(rng.random_range(-1.5..1.5), rng.random_range(-1.5..1.5));
                moved.solids.push(Solid { centre: solid.centre + step, ..solid });
            }
        }
        moved
    }

    /// Every side of every wall and piece of furniture.
    pub fn faces(&self) -> impl Iterator<Item = Face> {
        self.solids.iter().flat_map(Solid::faces)
    }

    /// The sides of walls, without furniture.
    pub(crate) fn wall_faces(&self) -> impl Iterator<Item = Face> {
        let walls = self.solids.iter().filter(|solid| solid.kind == Kind::Wall);
        walls.flat_map(Solid::faces)
    }

    /// Whether `point` lies in a wall or a piece of furniture.
    #[must_use]
    pub fn is_solid(&self, point: Point2<f64>) -> bool {
        self.solids.iter().any(|solid| solid.signed_distance(point) <= 0.0)
    }

    /// Metres from `point` to the nearest face, from inside or outside of its solid; infinite on
    /// an empty floor.
    #[must_use]
    pub fn distance_to_face(&self, point: Point2<f64>) -> f64 {
        let distances = self.solids.iter().map(|solid| solid.signed_distance(point).abs());
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Whether a disc of radius `clearance` about `point` is free.
    pub(crate) fn is_clear(&self, point: Point2<f64>, clearance: f64) -> bool {
        let mut solids = self.solids.iter();
        solids.all(|solid| solid.signed_distance(point) >= clearance)
    }

    /// The cells of the plan's frame whose centre is solid, and their frame.
    pub(crate) fn raster(&self, resolution: f64) -> Result<(GridFrame, Grid<bool>), SimError> {
        let frame = GridFrame::new(resolution, Se2::identity())?;
        let [width, height] = [self.size.x, self.size.y].map(|side| {
            let [cells, _] = frame.lattice_cell(Point2::new(side - 1e-9, 0.0));
            usize::try_from(cells + 1).unwrap_or(0)
        });
        let mut mask = Grid::filled(width, height, false)?;
        for solid in &self.solids {
            let reach = [0, 1].map(|axis| {
                let along = solid.corners().map(|corner| corner[axis]);
                let low = along.into_iter().fold(f64::INFINITY, f64::min);
                let high = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
                [low, high].map(|x| frame.lattice_cell(Point2::new(x, 0.0))[0].max(0))
            });
            let [columns, rows] = reach.map(|[low, high]| {
                usize::try_from(low).unwrap_or(0)..usize::try_from(high).unwrap_or(0) + 1
            });
            for row in rows {
                for column in columns.clone() {
                    let index = CellIndex { column, row };
                    if let Some(cell) = mask.get_mut(index) {
                        *cell |= solid.signed_distance(frame.cell_centre(index)) <= 0.0;
                    }
                }
            }
        }
        Ok((frame, mask))
    }
}

#[cfg(test)]
mod tests {
    use super::{Face, FloorPlan, Kind, Solid};
    use nalgebra::{Point2, Vector2};
    use std::f64::consts::FRAC_PI_6;

    #[test]
    fn faces_look_away_from_their_solid() {
        let centre = Point2::new(2.0, 1.0);
        let solid = Solid::new(Kind::Wall, centre, Vector2::new(1.0, 0.2), FRAC_PI_6);
        for face in solid.faces() {
            let middle = nalgebra::center(&face.start, &face.end);
            let step = face.outward() * 0.01;
            assert!((solid.signed_distance(middle + step) - 0.01).abs() < 1e-12);
            assert!((solid.signed_distance(middle - step) + 0.01).abs() < 1e-12);
            let corner = solid.signed_distance(face.start + (face.start - centre));
            assert!((corner - (face.start - centre).norm()).abs() < 1e-12);
        }
    }

    #[test]
    fn distance_is_to_the_segment_and_not_to_its_line() {
        let face = Face { start: Point2::new(0.0, 0.0), end: Point2::new(1.0, 0.0) };
        assert_eq!(face.distance(Point2::new(0.5, 2.0)), 2.0);
        assert_eq!(face.distance(Point2::new(4.0, 4.0)), 5.0);
    }

    #[test]
    fn the_raster_has_the_solid_area() {
        let plan = FloorPlan::plan_a();
        let (_, mask) = plan.raster(0.02).unwrap();
        assert_eq!((mask.width(), mask.height()), (700, 600));
        let solid = mask.cells().iter().filter(|&&cell| cell).count();
        let walls_and_boxes = 0.0004 * solid as f64;
        // Outer walls 5.91, corridor 3.20 less doors 0.76, partitions 2.92, furniture 7.69, less
        // 0.12 m² that two of them share.
        assert!((walls_and_boxes - 18.84).abs() < 0.1, "{walls_and_boxes} m²");
    }
}
