//! A deformation that lays walls on walls: patches follow, a smooth deformation follows them, in
//! turns.

use std::collections::BTreeMap;

use map_warp::{Motion, Warp};
use nalgebra::Point2;
use ogm_core::Steps;

use crate::MergeError;
use crate::parallel::map_in_order;

use super::params::BendParams;
use super::patch;
use super::walls::{Wall, Walls, square};

/// Sides of the patches, how far they look for walls, and how often at most, coarse to fine,
/// metres: a drift that grows along a building is followed from room to room, then from wall to wall.
const STAGES: [(f64, f64, usize); 4] =
    [(5.0, 0.8, 8), (3.0, 0.5, 4), (2.0, 0.35, 3), (1.0, 0.25, 3)];
/// Rounds of all stages.
pub(super) const MOST_ROUNDS: usize = {
    let [(.., first), (.., second), (.., third), (.., fourth)] = STAGES;
    first + second + third + fourth
};
/// Most patches: larger maps get larger ones, for the system of all is dense.
const MOST_PATCHES: usize = 150;
/// Walls that a fit looks at, forty for each of the most patches: of larger maps it takes one in so
/// many.
const MOST_WALLS: usize = 6_000;
/// Settled when no wall moves by more than this share of a cell.
const SETTLED_CELLS: f64 = 0.1;

/// Walls that are to lie on those of another map.
pub(super) struct Fit<'a> {
    target: &'a Walls,
    walls: Vec<Wall>,
    /// Metres a cell of their map.
    cell: f64,
}

impl<'a> Fit<'a> {
    pub(super) fn new(target: &'a Walls, walls: Vec<Wall>, cell: f64) -> Self {
        let stride = walls.len().div_ceil(MOST_WALLS).max(1);
        Self { target, walls: walls.into_iter().step_by(stride).collect(), cell }
    }

    /// The deformation, and how many patches it is fitted to; at most [`MOST_ROUNDS`] steps.
    pub(super) fn run(
        &self,
        params: &BendParams,
        rounds_done: &Steps<'_>,
    ) -> Result<(Warp, usize), MergeError> {
        let mut warp = Warp::fit(&[], &params.warp)?;
        let mut followed = 0;
        let mut places: Vec<Point2<f64>> = self.walls.iter().map(|wall| wall.at).collect();
        for (side, reach, rounds) in STAGES {
            let patches = self.patches(side);
            let mut step_m = f64::INFINITY;
            for _ in 0..rounds {
                rounds_done.step()?;
                let follow = |patch: &Vec<usize>| {
                    let walls = patch.iter().map(|&wall| (self.walls[wall], places[wall]));
                    patch::motion(self.target, &warp, walls.collect(), reach)
                };
                let motions = map_in_order(&patches, follow);
                let motions: Vec<Motion> = motions.into_iter().flatten().collect();
                followed = motions.len();
                warp = Warp::fit(&motions, &params.warp)?;
                let moved = map_in_order(&self.walls, |wall| warp.apply(wall.at));
                let steps =
                    places.iter().zip(&moved).map(|(before, after)| (after - before).norm());
                let farthest = steps.fold(0.0, f64::max);
                places = moved;
                // What comes no nearer to rest mostly goes round in circles, patches believed and not.
                if farthest <= SETTLED_CELLS * self.cell || farthest >= step_m {
                    break;
                }
                step_m = farthest;
            }
        }
        Ok((warp, followed))
    }

    /// The walls, by their places in the list, in squares of `side` metres, or larger ones where
    /// these are too many.
    fn patches(&self, side: f64) -> Vec<Vec<usize>> {
        let mut side = side;
        loop {
            let mut patches: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
            for (index, wall) in self.walls.iter().enumerate() {
                patches.entry(square(wall.at.coords, side)).or_default().push(index);
            }
            if patches.len() <= MOST_PATCHES {
                return patches.into_values().collect();
            }
            side *= 1.2;
        }
    }
}
