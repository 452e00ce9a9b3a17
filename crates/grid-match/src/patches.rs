//! How well two maps fit where each part of one may move a little: maps are bent by drift.

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};
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
/// How far a patch may move from where its neighbour would take it, metres and radians.
const FROM_NEIGHBOUR: (f64, f64) = (0.4, 0.08);
/// And from the pose of the whole map, in all.
const FROM_POSE: (f64, f64) = (1.5, 0.2);

/// A part of a map and where it fits best.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovedPatch {
    /// The middle of its walls, in its map.
    pub(crate) centre: Point2<f64>,
    /// Where the other map sees it rather than at the pose of the whole map.
    pub(crate) on_from_map: Se2,
    /// Metres of its wall that fit there, and all.
    pub(crate) hit_m: f64,
    pub(crate) wall_m: f64,
}

/// Walls of a map on another, each patch where it fits best.
pub(crate) struct RelaxedWalls {
    pub(crate) counts: WallCounts,
    /// Metres of matched wall across the weaker direction of each patch.
    pub(crate) cross_m: f64,
    /// Root mean square by which the patches moved, metres.
    pub(crate) moved_m: f64,
    pub(crate) patches: Vec<MovedPatch>,
}

/// Lets the patches of `map` follow the walls of `on` near `on_from_map`: first the one that fits
/// best there, then its neighbours from where it went, and so on, so that a drift may grow from
/// patch to patch.
pub(crate) fn relax(
    map: &PreparedMap,
    on: &PreparedMap,
    on_from_map: &Se2,
    reach: Reach,
    most: usize,
) -> RelaxedWalls {
    let used = &map.walls[..map.walls.len().min(most)];
    let length = map.wall_length() / used.len().max(1) as f64;
    let mut places: BTreeMap<[usize; 2], Vec<WallPoint>> = BTreeMap::new();
    for &wall in used {
        let place = [wall.at.x, wall.at.y].map(|along| floor_index(along / PATCH_M));
        places.entry(place).or_default().push(wall);
    }
    let chain = Chain { on, on_from_map: *on_from_map, reach, length, places };
    chain.settle()
}

struct Chain<'a> {
    on: &'a PreparedMap,
    on_from_map: Se2,
    reach: Reach,
    length: f64,
    places: BTreeMap<[usize; 2], Vec<WallPoint>>,
}

impl Chain<'_> {
    fn settle(&self) -> RelaxedWalls {
        let mut settled: BTreeMap<[usize; 2], (Se2, WallCounts)> = BTreeMap::new();
        // Patches that may go next, with the pose that a neighbour suggests.
        let mut rigid: Vec<([usize; 2], f64)> = self
            .places
            .iter()
            .map(|(&place, walls)| (place, self.counts(walls, &self.on_from_map).hit))
            .collect();
        rigid.sort_by(|a, b| b.1.total_cmp(&a.1));
        for &(start, _) in &rigid {
            if settled.contains_key(&start) {
                continue;
            }
            let mut open = std::collections::VecDeque::from([(start, self.on_from_map)]);
            while let Some((place, suggested_on_from_map)) = open.pop_front() {
                let Some(walls) = self.places.get(&place).filter(|_| !settled.contains_key(&place))
                else {
                    continue;
                };
                let (pose, counts) = self.best(walls, suggested_on_from_map);
                let is_sure = counts.hit >= 0.5 * (walls.len() as f64 * self.length);
                settled.insert(place, (pose, counts));
                if is_sure {
                    let around = neighbours(place).filter(|near| self.places.contains_key(near));
                    open.extend(around.map(|near| (near, pose)));
                }
            }
        }
        self.summed(&settled)
    }

    /// Where `walls` fit best of where they are, where a neighbour would take them, and where they
    /// go from there.
    fn best(&self, walls: &[WallPoint], suggested_on_from_map: Se2) -> (Se2, WallCounts) {
        let centre = centroid(walls);
        let mut best = (self.on_from_map, self.counts(walls, &self.on_from_map));
        if walls.len() < LEAST_POINTS {
            return best;
        }
        let mut starts = vec![suggested_on_from_map];
        if suggested_on_from_map != self.on_from_map {
            starts.push(self.on_from_map);
        }
        for start_on_from_map in starts {
            let followed_on_from_map = follow(self.on, walls, start_on_from_map, &SCALES);
            let near = |placed_on_from_map: &Se2, (step, turn): (f64, f64)| {
                (followed_on_from_map * centre - *placed_on_from_map * centre).norm() <= step
                    && wrap_angle(followed_on_from_map.theta() - placed_on_from_map.theta()).abs()
                        <= turn
            };
            if near(&start_on_from_map, FROM_NEIGHBOUR) && near(&self.on_from_map, FROM_POSE) {
                let counts = self.counts(walls, &followed_on_from_map);
                if counts.fits_better_than(&best.1) {
                    best = (followed_on_from_map, counts);
                }
            }
        }
        best
    }

    fn counts(&self, walls: &[WallPoint], on_from_map: &Se2) -> WallCounts {
        let mut counts = WallCounts::default();
        counts.add(walls, self.on, on_from_map, self.reach, self.length);
        counts
    }

    fn summed(&self, settled: &BTreeMap<[usize; 2], (Se2, WallCounts)>) -> RelaxedWalls {
        let mut counts = WallCounts::default();
        let (mut cross_m, mut moved, mut points) = (0.0, 0.0, 0.0);
        let mut patches = Vec::new();
        for (place, (pose, of_patch)) in settled {
            let walls = &self.places[place];
            let centre = centroid(walls);
            let step = (*pose * centre - self.on_from_map * centre).norm();
            moved += step * step * walls.len() as f64;
            points += walls.len() as f64;
            counts.merge(of_patch);
            cross_m += of_patch.cross();
            let (hit_m, wall_m) = (of_patch.hit, walls.len() as f64 * self.length);
            patches.push(MovedPatch { centre, on_from_map: *pose, hit_m, wall_m });
        }
        let moved_m = (moved / f64::max(points, 1.0)).sqrt();
        RelaxedWalls { counts, cross_m, moved_m, patches }
    }
}

fn neighbours([column, row]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    (row.saturating_sub(1)..=row + 1).flat_map(move |near_row| {
        (column.saturating_sub(1)..=column + 1)
            .map(move |near_column| [near_column, near_row])
            .filter(move |&near| near != [column, row])
    })
}

fn centroid(walls: &[WallPoint]) -> Point2<f64> {
    let sum: Vector2<f64> = walls.iter().map(|wall| wall.at.coords).sum();
    Point2::from(sum / walls.len().max(1) as f64)
}
