//! Floor plans drawn at random.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::FRAC_PI_4;

use crate::draw::{Stream, generator};
use crate::plan::{Kind, Solid};
use crate::plan_text::{Door, Wall, cut};
use crate::rounds::rounds;
use crate::symmetry::refuse_symmetric;
use crate::{FloorPlan, Robot, SimError};

/// Plans drawn before giving up.
const ATTEMPTS: u64 = 100;
/// A plan is refused when this share of it stays in place after a turn. The outer walls and a
/// corridor in the middle make up about two thirds.
const SYMMETRIC_SHARE: f64 = 0.9;
const THICKNESS: f64 = 0.12;
/// From the frame to the centre line of the outer walls, metres.
const MARGIN: f64 = 0.34;
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
    pub(crate) fn area(&self) -> f64 {
        let size = self.high - self.low;
        size.x * size.y
    }

    /// A point at least `inset` from the walls' centre lines, if the room is that large.
    pub(crate) fn point(&self, inset: f64, rng: &mut ChaCha8Rng) -> Point2<f64> {
        let along =
            |low: f64, high: f64, share: f64| low + inset + (high - low - 2.0 * inset) * share;
        let [x, y] = [rng.random(), rng.random()];
        Point2::new(along(self.low.x, self.high.x, x), along(self.low.y, self.high.y, y))
    }
}

/// A building under construction, its corridor along x.
struct Building {
    size: Vector2<f64>,
    corridor: Room,
    rooms: Vec<Room>,
    walls: Vec<Wall>,
    doors: Vec<Door>,
    furniture: Vec<Solid>,
}

impl FloorPlan {
    /// An office floor drawn at random: four to eight rooms along a corridor, 12–17 × 10–13.5 m or
    /// the other way round, with doors, piers, furniture, and routes for two robots that share
    /// about 60 % of what they see. No plan equals itself turned by 90 or 180 degrees.
    ///
    /// # Errors
    /// That of the last attempt, if none of a hundred gives a plan that robots can explore.
    pub fn random(seed: u64) -> Result<Self, SimError> {
        let mut outcome = Err(SimError::SymmetricPlan { degrees: 180 });
        for attempt in 0..ATTEMPTS {
            outcome = Self::draw(&mut generator(seed, Stream::Plan, attempt));
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    fn draw(rng: &mut ChaCha8Rng) -> Result<Self, SimError> {
        let mut building = Building::shell(rng);
        building.add_rooms(MARGIN, building.corridor.low.y, rng);
        building.add_rooms(building.corridor.high.y, building.size.y - MARGIN, rng);
        building.furnish(rng);
        if rng.random_bool(0.5) {
            building.transpose();
        }
        let (corridor, rooms) = (building.corridor, building.rooms);
        let mut solids = cut(&building.walls, &building.doors);
        solids.extend(building.furniture);
        let plan = Self::new(building.size, solids, Vec::new(), Vec::new());
        refuse_symmetric(&plan, SYMMETRIC_SHARE)?;
        let [target, source] = rounds(&plan, corridor, rooms, rng)?;
        let plan = plan.with_routes(target, source);
        for robot in [Robot::Target, Robot::Source] {
            plan.path(robot, 0.05)?;
        }
        Ok(plan)
    }
}

impl Building {
    /// Outer walls and corridor.
    fn shell(rng: &mut ChaCha8Rng) -> Self {
        let size = Vector2::new(rng.random_range(12.0..17.0), rng.random_range(10.0..13.5));
        let (right, top) = (size.x - MARGIN, size.y - MARGIN);
        let low = rng.random_range(0.33..0.47) * size.y;
        let high = low + rng.random_range(1.5..2.1);
        let mut building = Self {
            size,
            corridor: Room { low: Point2::new(MARGIN, low), high: Point2::new(right, high) },
            rooms: Vec::new(),
            walls: Vec::new(),
            doors: Vec::new(),
            furniture: Vec::new(),
        };
        building.wall([MARGIN, MARGIN], [right, MARGIN]);
        building.wall([right, MARGIN], [right, top]);
        building.wall([right, top], [MARGIN, top]);
        building.wall([MARGIN, top], [MARGIN, MARGIN]);
        building.wall([MARGIN, low], [right, low]);
        building.wall([MARGIN, high], [right, high]);
        building
    }

    fn wall(&mut self, start: [f64; 2], end: [f64; 2]) {
        self.walls.push(Wall { start: start.into(), end: end.into(), thickness: THICKNESS });
    }

    fn door(&mut self, x: f64, y: f64) {
        self.doors.push(Door { centre: Point2::new(x, y), width: DOOR });
    }

    /// Rooms between `low` and `high` on one side of the corridor, each with a door to it, some
    /// with one to the next room, some with a pier.
    fn add_rooms(&mut self, low: f64, high: f64, rng: &mut ChaCha8Rng) {
        let below = low < self.corridor.low.y;
        let (door_y, outer_y) = if below { (high, low) } else { (low, high) };
        let count = rng.random_range(2..=4_u32);
        let width = (self.size.x - 2.0 * MARGIN) / f64::from(count);
        let mut left = MARGIN;
        for room in 1..=count {
            let even = MARGIN + width * f64::from(room);
            let right =
                if room < count { even + rng.random_range(-0.22..0.22) * width } else { even };
            if room < count {
                self.wall([right, low], [right, high]);
                if rng.random_bool(0.3) {
                    self.door(right, rng.random_range(low + 0.9..high - 0.9));
                }
            }
            self.door(rng.random_range(left + 0.8..right - 0.8), door_y);
            if rng.random_bool(0.5) {
                let x = rng.random_range(left + 0.8..right - 0.8);
                let depth = rng.random_range(0.5..1.2);
                let tip = if below { outer_y + depth } else { outer_y - depth };
                self.wall([x, outer_y], [x, tip]);
                if rng.random_bool(0.4) {
                    let reach = rng.random_range(0.3..0.7);
                    self.wall([x - THICKNESS / 2.0, tip], [x + reach, tip]);
                }
            }
            self.rooms.push(Room { low: Point2::new(left, low), high: Point2::new(right, high) });
            left = right;
        }
    }

    /// Up to two pieces of furniture a room, half of them askew, none in front of a door.
    fn furnish(&mut self, rng: &mut ChaCha8Rng) {
        let mut places: Vec<Point2<f64>> = self.doors.iter().map(|door| door.centre).collect();
        for room in &self.rooms {
            for _ in 0..2 {
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
    fn transpose(&mut self) {
        let swap = |point: Point2<f64>| Point2::new(point.y, point.x);
        self.size = self.size.yx();
        for wall in &mut self.walls {
            (wall.start, wall.end) = (swap(wall.start), swap(wall.end));
        }
        for door in &mut self.doors {
            door.centre = swap(door.centre);
        }
        for room in self.rooms.iter_mut().chain([&mut self.corridor]) {
            (room.low, room.high) = (swap(room.low), swap(room.high));
        }
        for solid in &mut self.furniture {
            *solid = solid.transposed();
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::navigate::FreeSpace;
    use crate::{FloorPlan, Robot};
    use nalgebra::Point2;

    /// Points of a lattice of 0.1 m over the plan.
    fn lattice(plan: &FloorPlan) -> impl Iterator<Item = Point2<f64>> {
        let steps =
            |side: f64| (0_u32..).map(|i| 0.1 * f64::from(i)).take_while(move |&x| x < side);
        let size = plan.size();
        steps(size.x).flat_map(move |x| steps(size.y).map(move |y| Point2::new(x, y)))
    }

    #[test]
    fn a_robot_reaches_every_room() {
        for seed in 0..4 {
            let plan = FloorPlan::random(seed).unwrap();
            let (frame, solid) = plan.raster(0.05).unwrap();
            let start = plan.route(Robot::Target)[0];
            let reached = FreeSpace::around(&solid, &frame, 0.25, start).unwrap().area();
            let room = lattice(&plan).filter(|&point| plan.is_clear(point, 0.25)).count();
            let share = reached / (0.01 * room as f64);
            assert!(share > 0.93, "{share} of plan {seed}");
        }
    }

    #[test]
    fn no_plan_turns_into_itself() {
        for seed in 0..4 {
            let plan = FloorPlan::random(seed).unwrap();
            let size = plan.size();
            let solid: Vec<_> = lattice(&plan).filter(|&point| plan.is_solid(point)).collect();
            let kept = solid.iter().filter(|point| {
                let turned = Point2::new(size.x - point.x, size.y - point.y);
                plan.is_solid(turned) || plan.distance_to_face(turned) < 0.05
            });
            let share = kept.count() as f64 / solid.len() as f64;
            assert!(share < 0.95, "{share} of plan {seed} stays under half a turn");
        }
    }
}
