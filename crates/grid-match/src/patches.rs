//! How well two maps fit where each part of one may move a little: maps are bent by drift.

use std::collections::BTreeMap;

use nalgebra::Point2;
use ogm_core::{Se2, wrap_angle};

use crate::lattice::floor_index;
use crate::prepare::PreparedMap;
use crate::refine::follow;
use crate::wall_counts::{Reach, WallCounts};
use crate::wall_points::WallPoint;

/// Side of a patch, metres: about a room, over which a map is hardly bent.
const PATCH_M: f64 = 4.0;
/// Fewest wall points of a patch that may move.
const LEAST_POINTS: usize = 15;
/// Scales by which a patch follows the walls of the other map, metres.
const SCALES: [f64; 4] = [0.4, 0.3, 0.2, 0.15];
/// How far a patch may move, metres and radians.
const FREEDOM: (f64, f64) = (0.5, 0.1);

/// Walls of `map` on `on`, each patch where it fits best near `on_from_map`, and the root mean
/// square by which the patches moved, metres.
pub(crate) fn relaxed_counts(
    map: &PreparedMap,
    on: &PreparedMap,
    on_from_map: &Se2,
    reach: Reach,
    most: usize,
) -> (WallCounts, f64) {
    let used = &map.walls[..map.walls.len().min(most)];
    let length = map.wall_length() / used.len().max(1) as f64;
    let mut patches: BTreeMap<[usize; 2], Vec<WallPoint>> = BTreeMap::new();
    for &wall in used {
        let place = [wall.at.x, wall.at.y].map(|along| floor_index(along / PATCH_M));
        patches.entry(place).or_default().push(wall);
    }
    let mut counts = WallCounts::default();
    let (mut moved, mut count) = (0.0, 0.0);
    for walls in patches.values() {
        let centre = centroid(walls);
        let mut patch_on_from_map = *on_from_map;
        if walls.len() >= LEAST_POINTS {
            let followed_on_from_map = follow(on, walls, *on_from_map, &SCALES);
            let step = (followed_on_from_map * centre - *on_from_map * centre).norm();
            let turn = wrap_angle(followed_on_from_map.theta() - on_from_map.theta()).abs();
            if step <= FREEDOM.0 && turn <= FREEDOM.1 {
                patch_on_from_map = followed_on_from_map;
                moved += step * step * walls.len() as f64;
            }
        }
        count += walls.len() as f64;
        counts.add(walls, on, &patch_on_from_map, reach, length);
    }
    (counts, (moved / f64::max(count, 1.0)).sqrt())
}

fn centroid(walls: &[WallPoint]) -> Point2<f64> {
    let sum: nalgebra::Vector2<f64> = walls.iter().map(|wall| wall.at.coords).sum();
    Point2::from(sum / walls.len().max(1) as f64)
}
