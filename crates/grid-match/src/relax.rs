//! How well two maps fit where each part of one may move a little: maps are bent by drift.

use std::collections::VecDeque;

use nalgebra::Point2;
use ogm_core::{Se2, wrap_angle};

use crate::parallel::both;
use crate::patches::{Patch, centroid};
use crate::prepare::PreparedMap;
use crate::refine::follow;
use crate::wall_counts::{PatchSums, Reach, WallCounts};
use crate::wall_points::WallPoint;

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
    pub(crate) sums: PatchSums,
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
    let used = map.walls.len().min(most);
    let length = map.wall_length() / used.max(1) as f64;
    let parts = map.patches.iter().map(|patch| Part { patch, walls: patch.walls(most) });
    let parts = parts.collect();
    let chain = Chain { on, on_from_map: *on_from_map, reach, length, most, parts };
    chain.settle()
}

/// A patch and those of its walls that are looked at.
struct Part<'a> {
    patch: &'a Patch,
    walls: &'a [WallPoint],
}

struct Chain<'a> {
    on: &'a PreparedMap,
    on_from_map: Se2,
    reach: Reach,
    length: f64,
    most: usize,
    parts: Vec<Part<'a>>,
}

impl Chain<'_> {
    fn settle(&self) -> RelaxedWalls {
        let rigid: Vec<WallCounts> =
            self.parts.iter().map(|part| self.counts(part.walls, &self.on_from_map)).collect();
        let mut settled: Vec<Option<(Se2, WallCounts)>> = vec![None; self.parts.len()];
        let mut starts: Vec<usize> = (0..self.parts.len()).collect();
        starts.sort_by(|&a, &b| rigid[b].hit.total_cmp(&rigid[a].hit));
        for start in starts {
            // Parts that may go next, with the pose that a neighbour suggests.
            let mut open = VecDeque::from([(start, self.on_from_map)]);
            while let Some((index, suggested_on_from_map)) = open.pop_front() {
                let walls = self.parts[index].walls;
                if walls.is_empty() || settled[index].is_some() {
                    continue;
                }
                let (pose, counts) = self.best(walls, rigid[index], suggested_on_from_map);
                let is_sure = counts.hit >= 0.5 * (walls.len() as f64 * self.length);
                settled[index] = Some((pose, counts));
                if is_sure {
                    open.extend(self.parts[index].patch.around.iter().map(|&near| (near, pose)));
                }
            }
        }
        self.summed(&settled)
    }

    /// Where `walls` fit best of where they are, with `rigid` counts there, where a neighbour would
    /// take them, and where they go from there.
    fn best(
        &self,
        walls: &[WallPoint],
        rigid: WallCounts,
        suggested_on_from_map: Se2,
    ) -> (Se2, WallCounts) {
        let centre = centroid(walls);
        let mut best = (self.on_from_map, rigid);
        if walls.len() < LEAST_POINTS {
            return best;
        }
        let followed = |start_on_from_map: Se2| {
            let followed_on_from_map = follow(self.on, walls, start_on_from_map, &SCALES);
            let near = |placed_on_from_map: &Se2, (step, turn): (f64, f64)| {
                (followed_on_from_map * centre - *placed_on_from_map * centre).norm() <= step
                    && wrap_angle(followed_on_from_map.theta() - placed_on_from_map.theta()).abs()
                        <= turn
            };
            (near(&start_on_from_map, FROM_NEIGHBOUR) && near(&self.on_from_map, FROM_POSE))
                .then(|| (followed_on_from_map, self.counts(walls, &followed_on_from_map)))
        };
        let is_led = suggested_on_from_map != self.on_from_map;
        let (suggested, alone) = both(
            || followed(suggested_on_from_map),
            || is_led.then(|| followed(self.on_from_map)).flatten(),
        );
        for found in [suggested, alone].into_iter().flatten() {
            if found.1.fits_better_than(&best.1) {
                best = found;
            }
        }
        best
    }

    fn counts(&self, walls: &[WallPoint], on_from_map: &Se2) -> WallCounts {
        let mut counts = WallCounts::default();
        counts.add(walls, self.on, on_from_map, self.reach, self.length);
        counts
    }

    fn summed(&self, settled: &[Option<(Se2, WallCounts)>]) -> RelaxedWalls {
        let mut sums = PatchSums::default();
        let (mut moved, mut points) = (0.0, 0.0);
        let mut patches = Vec::new();
        for (part, settled) in self.parts.iter().zip(settled) {
            let Some((pose, of_patch)) = settled else { continue };
            let walls = part.walls;
            let centre = centroid(walls);
            let step = (*pose * centre - self.on_from_map * centre).norm();
            moved += step * step * walls.len() as f64;
            points += walls.len() as f64;
            let placed_walls = part.patch.placed_walls(self.most);
            sums.add(placed_walls, self.on, pose, self.reach, self.length);
            let (hit_m, wall_m) = (of_patch.hit, walls.len() as f64 * self.length);
            patches.push(MovedPatch { centre, on_from_map: *pose, hit_m, wall_m });
        }
        let moved_m = (moved / f64::max(points, 1.0)).sqrt();
        RelaxedWalls { sums, moved_m, patches }
    }
}
