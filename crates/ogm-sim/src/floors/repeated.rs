//! Floors that look like themselves elsewhere.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;

use super::offices::row;
use crate::draft::{Draft, MARGIN, Room};
use crate::plan::{Kind, Solid};
use crate::plan_text::Door;

/// A corridor with equal rooms on one side or both, equally furnished; on some floors, some rooms
/// hold something of their own.
pub(super) fn draw_rooms(rng: &mut ChaCha8Rng) -> Draft {
    let count = rng.random_range(4..=9_u32);
    let room = Vector2::new(rng.random_range(2.6..4.5), rng.random_range(3.0..5.0));
    let corridor = rng.random_range(1.5..2.2);
    let sides = rng.random_range(1..=2_u32);
    let length = 2.0 * MARGIN + f64::from(count) * room.x;
    let mut draft =
        Draft::new(Vector2::new(length, 2.0 * MARGIN + corridor + f64::from(sides) * room.y));
    let door = rng.random_range(0.7..room.x - 0.7);
    let pieces: Vec<[f64; 4]> = (0..rng.random_range(0..=2))
        .map(|_| {
            [rng.random(), rng.random(), rng.random_range(0.4..1.4), rng.random_range(0.4..0.8)]
        })
        .collect();
    let own_share = [0.0, 0.3, 0.8][rng.random_range(0..3)];
    let right = length - MARGIN;
    for side in 0..sides {
        let below = side == 0;
        let low = if below { MARGIN } else { MARGIN + room.y + corridor };
        let high = low + room.y;
        let door_y = if below { high } else { low };
        draft.wall([MARGIN, door_y], [right, door_y]);
        for index in 0..count {
            let left = MARGIN + f64::from(index) * room.x;
            if index > 0 {
                draft.wall([left, low], [left, high]);
            }
            draft.door(left + door, door_y);
            for &[x, y, width, depth] in &pieces {
                let deep = if below { low + 0.6 } else { high - 0.6 };
                let inward = if below { 1.0 } else { -1.0 };
                let centre = Point2::new(
                    left + 0.6 + x * (room.x - 1.2),
                    deep + inward * y * (room.y - 2.4).max(0.0),
                );
                let size = Vector2::new(width, depth);
                draft.furniture.push(Solid::new(Kind::Furniture, centre, size, 0.0));
            }
            if rng.random_bool(own_share) {
                let inside = Room::new([left, low], [left + room.x, high]);
                draft.furnish(&[inside], 1, rng);
            }
        }
    }
    draft
}

/// A corridor in the middle, rooms below it, and above it the same rooms turned by half a turn;
/// on some floors, a few pieces of furniture have no counterpart.
pub(super) fn draw_half_turn(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(12.0..28.0), rng.random_range(9.0..14.0));
    let mut draft = Draft::new(size);
    let outer = draft.walls.len();
    let low = (size.y - rng.random_range(1.5..2.4)) / 2.0;
    let rooms = row(&mut draft, [MARGIN, low], low, rng);
    draft.wall([MARGIN, low], [size.x - MARGIN, low]);
    let pieces = rng.random_range(0..=2);
    draft.furnish(&rooms, pieces, rng);
    let turned = |point: Point2<f64>| Point2::from(size - point.coords);
    for index in outer..draft.walls.len() {
        let mut wall = draft.walls[index];
        (wall.start, wall.end) = (turned(wall.start), turned(wall.end));
        draft.walls.push(wall);
    }
    let doors: Vec<Door> =
        draft.doors.iter().map(|door| Door { centre: turned(door.centre), ..*door }).collect();
    draft.doors.extend(doors);
    let furniture: Vec<Solid> =
        draft.furniture.iter().map(|solid| solid.half_turned(size)).collect();
    draft.furniture.extend(furniture);
    let inside = draft.inside();
    if rng.random_bool(0.5) {
        for _ in 0..rng.random_range(1..=4) {
            let size = Vector2::new(rng.random_range(0.4..1.5), rng.random_range(0.3..0.8));
            let angle = rng.random_range(0.0..PI);
            let centre = inside.point(0.6, rng);
            draft.furniture.push(Solid::new(Kind::Furniture, centre, size, angle));
        }
    }
    draft
}
