//! A corridor around a closed core.

use nalgebra::Vector2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::{Draft, MARGIN, Room};

/// Least metres of corridor beside a room, for its door.
const LEAST_FRONT: f64 = 1.6;

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(20.0..34.0), rng.random_range(15.0..24.0));
    let mut draft = Draft::new(size);
    // Four different depths and widths: no end of the ring looks like the other.
    let outer = inset(&draft.inside(), rng, [2.6, 4.6]);
    let core = inset(&outer, rng, [1.4, 2.6]);
    frame(&mut draft, &outer);
    frame(&mut draft, &core);
    let rooms = [rows(&mut draft, &outer, rng), columns(&mut draft, &outer, rng)].concat();
    let pieces = rng.random_range(0..=2);
    draft.furnish(&rooms, pieces, rng);
    draft
}

/// `room` without a strip of its own width on each side.
fn inset(room: &Room, rng: &mut ChaCha8Rng, [least, most]: [f64; 2]) -> Room {
    let mut strip = || Vector2::new(rng.random_range(least..most), rng.random_range(least..most));
    Room { low: room.low + strip(), high: room.high - strip() }
}

/// Walls around `room`.
fn frame(draft: &mut Draft, room: &Room) {
    let (low, high) = (room.low, room.high);
    draft.wall([low.x, low.y], [high.x, low.y]);
    draft.wall([high.x, low.y], [high.x, high.y]);
    draft.wall([high.x, high.y], [low.x, high.y]);
    draft.wall([low.x, high.y], [low.x, low.y]);
}

/// Rooms below and above the corridor, over the whole width.
fn rows(draft: &mut Draft, outer: &Room, rng: &mut ChaCha8Rng) -> Vec<Room> {
    let [end, top] = [draft.size.x - MARGIN, draft.size.y - MARGIN];
    let mut rooms = Vec::new();
    for ([low, high], door_y) in
        [([MARGIN, outer.low.y], outer.low.y), ([outer.high.y, top], outer.high.y)]
    {
        let mut left = MARGIN;
        for right in splits([outer.low.x, outer.high.x], end, rng) {
            if right < end {
                draft.wall([right, low], [right, high]);
            }
            let [from, to] = [left.max(outer.low.x), right.min(outer.high.x)];
            draft.door(rng.random_range(from + 0.6..to - 0.6), door_y);
            rooms.push(Room::new([left, low], [right, high]));
            left = right;
        }
    }
    rooms
}

/// Rooms to the left and right of the corridor, between the rows.
fn columns(draft: &mut Draft, outer: &Room, rng: &mut ChaCha8Rng) -> Vec<Room> {
    let end = draft.size.x - MARGIN;
    let [bottom, top] = [outer.low.y, outer.high.y];
    let mut rooms = Vec::new();
    for ([left, right], door_x) in
        [([MARGIN, outer.low.x], outer.low.x), ([outer.high.x, end], outer.high.x)]
    {
        draft.wall([left, bottom], [right, bottom]);
        draft.wall([left, top], [right, top]);
        let mut low = bottom;
        for high in splits([bottom, top], top, rng) {
            if high < top {
                draft.wall([left, high], [right, high]);
            }
            draft.door(door_x, rng.random_range(low + 0.6..high - 0.6));
            rooms.push(Room::new([left, low], [right, high]));
            low = high;
        }
    }
    rooms
}

/// Where rooms end along a side whose corridor runs from `from` to `to`; the last at `end`.
fn splits([from, to]: [f64; 2], end: f64, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut ends = Vec::new();
    let mut at = from + rng.random_range(LEAST_FRONT..5.0);
    while at < to - LEAST_FRONT {
        ends.push(at);
        at += rng.random_range(2.2..6.0);
    }
    ends.push(end);
    ends
}
