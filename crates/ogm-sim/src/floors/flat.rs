//! A rectangle cut into rooms, each cut with a door in it.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::{Draft, Room};

/// Metres that a wall keeps from a door that it would end at.
const BESIDE_DOOR: f64 = 0.65;

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(7.0..16.0), rng.random_range(6.0..12.0));
    let mut draft = Draft::new(size);
    let mut rooms = Vec::new();
    let whole = draft.inside();
    let largest = rng.random_range(9.0..22.0);
    divide(&mut draft, whole, largest, &mut rooms, rng);
    let pieces = rng.random_range(0..=3);
    draft.furnish(&rooms, pieces, rng);
    draft
}

/// Cuts `room` until no part is larger than `largest` square metres or can be cut.
fn divide(
    draft: &mut Draft,
    room: Room,
    largest: f64,
    rooms: &mut Vec<Room>,
    rng: &mut ChaCha8Rng,
) {
    if room.area() > largest
        && let Some([one, other]) = cut(draft, room, rng)
    {
        divide(draft, one, largest, rooms, rng);
        divide(draft, other, largest, rooms, rng);
    } else {
        rooms.push(room);
    }
}

/// A wall with a door across the longer side of `room`, and the two halves.
fn cut(draft: &mut Draft, room: Room, rng: &mut ChaCha8Rng) -> Option<[Room; 2]> {
    let size = room.size();
    let across_x = size.x > size.y;
    let (long, short) = if across_x { (size.x, size.y) } else { (size.y, size.x) };
    if long < 4.4 || short < 1.8 {
        return None;
    }
    let (low, high) = (room.low, room.high);
    (0..8).find_map(|_| {
        let at = long * rng.random_range(0.35..0.65);
        let along = rng.random_range(0.7..short - 0.7);
        let (start, end, door) = if across_x {
            let x = low.x + at;
            ([x, low.y], [x, high.y], [x, low.y + along])
        } else {
            let y = low.y + at;
            ([low.x, y], [high.x, y], [low.x + along, y])
        };
        let meets_door = draft.doors.iter().any(|door| {
            [start, end].iter().any(|&end| (door.centre - Point2::from(end)).norm() < BESIDE_DOOR)
        });
        if meets_door {
            return None;
        }
        draft.wall(start, end);
        draft.door(door[0], door[1]);
        Some([Room { low, high: end.into() }, Room { low: start.into(), high }])
    })
}
