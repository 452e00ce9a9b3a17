//! Floor plans drawn at random.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::{Draft, MARGIN, Room, THICKNESS};
use crate::draw::{Stream, generator};
use crate::rounds::rounds;
use crate::symmetry::refuse_symmetric;
use crate::{FloorPlan, SOURCE, SimError, TARGET};

/// Plans drawn before giving up.
const ATTEMPTS: u64 = 100;
/// A plan is refused when this share of it stays in place after a turn. The outer walls and a
/// corridor in the middle make up about two thirds.
const SYMMETRIC_SHARE: f64 = 0.9;
/// A building under construction, its corridor along x.
struct Building {
    draft: Draft,
    corridor: Room,
    rooms: Vec<Room>,
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
        building.add_rooms(building.corridor.high.y, building.draft.size.y - MARGIN, rng);
        building.draft.furnish(&building.rooms, 2, rng);
        if rng.random_bool(0.5) {
            building.transpose();
        }
        let Building { draft, corridor, rooms } = building;
        let plan = draft.into_plan();
        refuse_symmetric(&plan, SYMMETRIC_SHARE)?;
        let [target, source] = rounds(&plan, corridor, rooms, rng)?;
        let plan = plan.with_routes(target, source);
        for robot in [TARGET, SOURCE] {
            plan.path(robot, 0.05)?;
        }
        Ok(plan)
    }
}

impl Building {
    /// Outer walls and corridor.
    fn shell(rng: &mut ChaCha8Rng) -> Self {
        let size = Vector2::new(rng.random_range(12.0..17.0), rng.random_range(10.0..13.5));
        let right = size.x - MARGIN;
        let low = rng.random_range(0.33..0.47) * size.y;
        let high = low + rng.random_range(1.5..2.1);
        let mut draft = Draft::new(size);
        draft.wall([MARGIN, low], [right, low]);
        draft.wall([MARGIN, high], [right, high]);
        Self { draft, corridor: Room::new([MARGIN, low], [right, high]), rooms: Vec::new() }
    }

    /// Rooms between `low` and `high` on one side of the corridor, each with a door to it, some
    /// with one to the next room, some with a pier.
    fn add_rooms(&mut self, low: f64, high: f64, rng: &mut ChaCha8Rng) {
        let below = low < self.corridor.low.y;
        let (door_y, outer_y) = if below { (high, low) } else { (low, high) };
        let count = rng.random_range(2..=4_u32);
        let width = (self.draft.size.x - 2.0 * MARGIN) / f64::from(count);
        let mut left = MARGIN;
        for room in 1..=count {
            let even = MARGIN + width * f64::from(room);
            let right =
                if room < count { even + rng.random_range(-0.22..0.22) * width } else { even };
            if room < count {
                self.draft.wall([right, low], [right, high]);
                if rng.random_bool(0.3) {
                    self.draft.door(right, rng.random_range(low + 0.9..high - 0.9));
                }
            }
            self.draft.door(rng.random_range(left + 0.8..right - 0.8), door_y);
            if rng.random_bool(0.5) {
                let x = rng.random_range(left + 0.8..right - 0.8);
                let depth = rng.random_range(0.5..1.2);
                let tip = if below { outer_y + depth } else { outer_y - depth };
                self.draft.wall([x, outer_y], [x, tip]);
                if rng.random_bool(0.4) {
                    let reach = rng.random_range(0.3..0.7);
                    self.draft.wall([x - THICKNESS / 2.0, tip], [x + reach, tip]);
                }
            }
            self.rooms.push(Room { low: Point2::new(left, low), high: Point2::new(right, high) });
            left = right;
        }
    }

    /// Swaps x and y.
    fn transpose(&mut self) {
        let swap = |point: Point2<f64>| Point2::new(point.y, point.x);
        self.draft.transpose();
        for room in self.rooms.iter_mut().chain([&mut self.corridor]) {
            (room.low, room.high) = (swap(room.low), swap(room.high));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::navigate::FreeSpace;
    use crate::{FloorPlan, TARGET};
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
            let start = plan.route(TARGET).unwrap()[0];
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
