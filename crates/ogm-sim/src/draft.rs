//! A floor under construction.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::FRAC_PI_4;

use crate::FloorPlan;
use crate::plan::{Kind, Solid};
use crate::plan_text::{Door, Wall, cut};

pub(crate) const THICKNESS: f64 = 0.12;
/// From the frame to the centre line of the outer walls, metres.
pub(crate) const MARGIN: f64 = 0.34;
const DOOR: f64 = 0.9;
/// Furniture keeps this far from doors, metres.
const DOORSTEP: f64 = 1.1;

/// A room: `low` and `high` corners between the centre lines of its walls.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Room {
    pub(crate) low: Point2<f64>,
    pub(crate) high: Point2<f64>,
}

impl Room {
    pub(crate) fn new(low: [f64; 2], high: [f64; 2]) -> Self {
        Self { low: low.into(), high: high.into() }
    }

    pub(crate) fn size(&self) -> Vector2<f64> {
        self.high - self.low
    }

    pub(crate) fn area(&self) -> f64 {
        self.size().x * self.size().y
    }

    /// A point at least `inset` from the walls' centre lines, if the room is that large.
    pub(crate) fn point(&self, inset: f64, rng: &mut ChaCha8Rng) -> Point2<f64> {
        let along =
            |low: f64, high: f64, share: f64| low + inset + (high - low - 2.0 * inset) * share;
        let [x, y] = [rng.random(), rng.random()];
        Point2::new(along(self.low.x, self.high.x, x), along(self.low.y, self.high.y, y))
    }
}

/// Walls, doors and furniture before doors are cut.
pub(crate) struct Draft {
    pub(crate) size: Vector2<f64>,
    pub(crate) walls: Vec<Wall>,
    pub(crate) doors: Vec<Door>,
    pub(crate) furniture: Vec<Solid>,
}

impl Draft {
    /// A floor of `size` with outer walls.
    pub(crate) fn new(size: Vector2<f64>) -> Self {
        let mut draft = Self { size, walls: Vec::new(), doors: Vec::new(), furniture: Vec::new() };
        let Room { low, high } = draft.inside();
        draft.wall([low.x, low.y], [high.x, low.y]);
        draft.wall([high.x, low.y], [high.x, high.y]);
        draft.wall([high.x, high.y], [low.x, high.y]);
        draft.wall([low.x, high.y], [low.x, low.y]);
        draft
    }

    /// What the outer walls enclose.
    pub(crate) fn inside(&self) -> Room {
        Room::new([MARGIN, MARGIN], [self.size.x - MARGIN, self.size.y - MARGIN])
    }

    pub(crate) fn wall(&mut self, start: [f64; 2], end: [f64; 2]) {
        self.walls.push(Wall { start: start.into(), end: end.into(), thickness: THICKNESS });
    }

    pub(crate) fn door(&mut self, x: f64, y: f64) {
        self.doors.push(Door { centre: Point2::new(x, y), width: DOOR });
    }

    /// Up to `pieces` a room, half of them askew, none in front of a door.
    pub(crate) fn furnish(&mut self, rooms: &[Room], pieces: u32, rng: &mut ChaCha8Rng) {
        let mut places: Vec<Point2<f64>> = self.doors.iter().map(|door| door.centre).collect();
        for room in rooms {
            for _ in 0..pieces {
                let size = Vector2::new(rng.random_range(0.5..1.5), rng.random_range(0.4..0.8));
                let angle = if rng.random_bool(0.5) {
                    rng.random_range(-FRAC_PI_4..FRAC_PI_4)
                } else {
                    0.0
                };
                let centre = room.point(0.5, rng);
                let keep = DOORSTEP + size.norm() / 2.0 - 0.4;
                if places.iter().all(|place| (place - centre).norm() > keep) {
                    self.furniture.push(Solid::new(Kind::Furniture, centre, size, angle));
                    places.push(centre);
                }
            }
        }
    }

    /// Swaps x and y.
    pub(crate) fn transpose(&mut self) {
        let swap = |point: Point2<f64>| Point2::new(point.y, point.x);
        self.size = self.size.yx();
        for wall in &mut self.walls {
            (wall.start, wall.end) = (swap(wall.start), swap(wall.end));
        }
        for door in &mut self.doors {
            door.centre = swap(door.centre);
        }
        for solid in &mut self.furniture {
            *solid = solid.transposed();
        }
    }

    /// The plan, without routes.
    pub(crate) fn into_plan(self) -> FloorPlan {
        let mut solids = cut(&self.walls, &self.doors);
        solids.extend(self.furniture);
        FloorPlan::new(self.size, solids, Vec::new(), Vec::new())
    }
}
