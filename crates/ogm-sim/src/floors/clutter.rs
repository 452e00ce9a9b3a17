//! One room full of things that stand askew.

use nalgebra::Vector2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;

use crate::draft::{Draft, THICKNESS};
use crate::plan::{Kind, Solid};

pub(super) fn draw(rng: &mut ChaCha8Rng) -> Draft {
    let size = Vector2::new(rng.random_range(9.0..20.0), rng.random_range(8.0..16.0));
    let mut draft = Draft::new(size);
    let room = draft.inside();
    for _ in 0..rng.random_range(2..6) {
        let length = Vector2::new(rng.random_range(1.5..4.5), THICKNESS);
        let screen =
            Solid::new(Kind::Wall, room.point(1.0, rng), length, rng.random_range(0.0..PI));
        draft.furniture.push(screen);
    }
    let pieces = (room.area() * rng.random_range(0.05..0.12)).ceil();
    let mut placed = 0.0;
    while placed < pieces {
        let size = Vector2::new(rng.random_range(0.3..1.6), rng.random_range(0.3..0.9));
        let angle = rng.random_range(0.0..PI);
        draft.furniture.push(Solid::new(Kind::Furniture, room.point(0.6, rng), size, angle));
        placed += 1.0;
    }
    draft
}
