//! A room with little in it: walls that end in the open, a few pillars.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::Draft;
use crate::plan::{Kind, Solid};

/// Least width of a passage, metres.
const PASSAGE: f64 = 1.0;

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let mut side = || 3.0 * f64::powf(6.0, rng.random());
    let size = Vector2::new(side(), side());
    let mut draft = Draft::new(size);
    for _ in 0..rng.random_range(0..=3) {
        spur(&mut draft, rng);
    }
    for _ in 0..rng.random_range(0..=2) {
        let side = rng.random_range(0.25..0.6);
        let place = draft.inside().point(0.9, rng);
        draft.furniture.push(Solid::new(Kind::Wall, place, Vector2::repeat(side), 0.0));
    }
    let pieces = rng.random_range(0..=4);
    let room = draft.inside();
    draft.furnish(&[room], pieces, rng);
    draft
}

/// A wall from a random place of an outer wall inwards, as far as leaves a passage.
fn spur(draft: &mut Draft, rng: &mut ChaCha8Rng) {
    let room = draft.inside();
    let size = room.size();
    let along_x = rng.random_bool(size.x / (size.x + size.y));
    let (across, depth) = if along_x { (size.x, size.y) } else { (size.y, size.x) };
    if across < 2.5 * PASSAGE {
        return;
    }
    let at = rng.random_range(PASSAGE..across - PASSAGE);
    let length = (rng.random_range(0.15..0.9) * depth).min(depth - PASSAGE);
    let (start, end) = if rng.random_bool(0.5) { (0.0, length) } else { (depth, depth - length) };
    let place = |inwards: f64| {
        let offset = if along_x { [at, inwards] } else { [inwards, at] };
        Point2::from(room.low.coords + Vector2::from(offset)).into()
    };
    draft.wall(place(start), place(end));
}
