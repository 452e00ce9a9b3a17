//! A hall with shelves, pillars and rooms in its corners.

use nalgebra::{Point2, Vector2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draft::{Draft, MARGIN};
use crate::plan::{Kind, Solid};

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(16.0..34.0), rng.random_range(12.0..24.0));
    let mut draft = Draft::new(size);
    let corner = Vector2::new(rng.random_range(3.0..6.0), rng.random_range(3.0..5.0));
    corner_room(&mut draft, corner, rng);
    shelves(&mut draft, corner + Vector2::repeat(MARGIN + 1.4), rng);
    for _ in 0..rng.random_range(0..10) {
        let side = rng.random_range(0.3..0.7);
        let place = draft.inside().point(1.2, rng);
        draft.furniture.push(Solid::new(Kind::Wall, place, Vector2::repeat(side), 0.0));
    }
    draft
}

/// A room of `size` in the lower-left corner.
fn corner_room(draft: &mut Draft, size: Vector2<f64>, rng: &mut ChaCha8Rng) {
    let [right, top] = [MARGIN + size.x, MARGIN + size.y];
    draft.wall([MARGIN, top], [right, top]);
    draft.wall([right, top], [right, MARGIN]);
    if rng.random_bool(0.5) {
        draft.door(rng.random_range(MARGIN + 0.7..right - 0.7), top);
    } else {
        draft.door(right, rng.random_range(MARGIN + 0.7..top - 0.7));
    }
}

/// Rows of shelves along x above and to the right of `from`, with gaps to pass.
fn shelves(draft: &mut Draft, from: Vector2<f64>, rng: &mut ChaCha8Rng) {
    let depth = rng.random_range(0.5..1.2);
    let mut y = MARGIN + 1.6;
    while y < draft.size.y - MARGIN - 1.6 {
        let mut x = if y < from.y { from.x } else { MARGIN + rng.random_range(1.2..2.5) };
        loop {
            let length = rng.random_range(1.0..7.0);
            if x + length > draft.size.x - MARGIN - 1.2 {
                break;
            }
            if rng.random_bool(0.8) {
                let centre = Point2::new(x + length / 2.0, y);
                let shelf = Solid::new(Kind::Furniture, centre, Vector2::new(length, depth), 0.0);
                draft.furniture.push(shelf);
            }
            x += length + rng.random_range(1.2..3.0);
        }
        y += depth + rng.random_range(1.6..3.6);
    }
}
