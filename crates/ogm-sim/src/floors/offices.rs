//! Rooms of many widths along a corridor.

use nalgebra::Vector2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::{Draft, MARGIN, Room};

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(14.0..34.0), rng.random_range(9.0..14.0));
    let mut draft = Draft::new(size);
    let low = rng.random_range(0.32..0.48) * size.y;
    let high = low + rng.random_range(1.5..2.4);
    let mut rooms = row(&mut draft, [MARGIN, low], low, rng);
    rooms.extend(row(&mut draft, [high, size.y - MARGIN], high, rng));
    let right = size.x - MARGIN;
    draft.wall([MARGIN, low], [right, low]);
    draft.wall([MARGIN, high], [right, high]);
    let pieces = rng.random_range(0..=3);
    draft.furnish(&rooms, pieces, rng);
    draft
}

/// Rooms between two heights, each with a door to the corridor at `door_y`, some with one to the
/// next room, some with a pier or a closet.
pub(super) fn row(
    draft: &mut Draft,
    [low, high]: [f64; 2],
    door_y: f64,
    rng: &mut ChaCha8Rng,
) -> Vec<Room> {
    let end = draft.size.x - MARGIN;
    let mut left = MARGIN;
    let mut rooms = Vec::new();
    while left < end {
        let width = rng.random_range(2.2..6.5);
        let right = if end - left - width < 2.2 { end } else { left + width };
        if right < end {
            draft.wall([right, low], [right, high]);
            if rng.random_bool(0.2) {
                draft.door(right, rng.random_range(low + 0.8..high - 0.8));
            }
        }
        draft.door(rng.random_range(left + 0.7..right - 0.7), door_y);
        let outer = if door_y == low { high } else { low };
        if rng.random_bool(0.4) {
            let x = rng.random_range(left + 0.7..right - 0.7);
            let depth = (outer - door_y).signum() * rng.random_range(0.4..1.2);
            draft.wall([x, outer], [x, outer - depth]);
            if rng.random_bool(0.4) {
                let reach = rng.random_range(-0.7..0.7);
                draft.wall([x, outer - depth], [x + reach, outer - depth]);
            }
        }
        rooms.push(Room::new([left, low], [right, high]));
        left = right;
    }
    rooms
}
