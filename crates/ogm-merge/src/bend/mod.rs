//! A bent map made straight: motions of patches and a smooth deformation, in turns, believed where
//! walls that were held out of the fit say so.

mod buckets;
mod held_out;
mod params;
mod patch;
mod report;
mod walls;

use std::collections::BTreeMap;

use map_warp::{Motion, Warp};
use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Progress, Se2, Stage};

use crate::MergeError;
use crate::merge::Component;

use self::held_out::{Held, PARTS, half_m, part};
use self::walls::{Wall, Walls, square};

pub use self::params::BendParams;
pub use self::report::{BendReport, BentComponent, BentMap};

/// Sides of the patches, how far they look for walls, and how often at most, coarse to fine,
/// metres: a drift that grows along a building is followed from room to room, then from wall to wall.
const STAGES: [(f64, f64, usize); 4] =
    [(5.0, 0.8, 8), (4.0, 0.5, 4), (3.0, 0.35, 2), (1.5, 0.25, 3)];
/// Most patches: larger maps get larger ones, for the system of all is dense.
const MOST_PATCHES: usize = 150;
/// Walls that a fit looks at, some sixty for each of the most patches: of larger maps it takes one
/// in so many.
const MOST_WALLS: usize = 10_000;
/// Settled when no wall moves by more than this share of a cell.
const SETTLED_CELLS: f64 = 0.1;

/// Bends `source`, which lies on `target` at `target_from_source`, so that its walls lie on those
/// of `target` as far as drift can have moved them.
///
/// Patches of the source follow the walls of the target; a smooth deformation without folds
/// ([`Warp`]) is fitted to their motions, and from where it puts them they follow again, first in
/// patches the size of a hall, then of a room. The same is done twice with half of the walls, squares
/// of a chessboard of 1 m; whether the other half then lies better than under any rigid motion
/// decides whether the bend is believed ([`BendReport::is_borne_out`]). The pose stays what it is: the deformation leads from
/// the source map to the same frame.
///
/// # Errors
/// A pose or parameter that cannot be meant, or a call that was cancelled. Maps with too little in
/// common are a report that is not borne out.
pub fn unbend(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: &Se2,
    params: &BendParams,
    progress: &dyn Progress,
) -> Result<BendReport, MergeError> {
    params.check()?;
    target_from_source.check_finite()?;
    let target = Walls::new(target, &target_from_source.inverse(), &params.thresholds);
    onto(&target, source, params, progress)
}

/// Makes the maps of a component straight, the first of its members being so: each of the others is
/// bent ([`unbend`]) onto the first and those before it, as they are after it. What is not borne out
/// stays as it is.
///
/// # Errors
/// A component that names a map which is not in `maps`, a pose or parameter that cannot be meant, or
/// a call that was cancelled.
pub fn unbend_component(
    maps: &[&OccupancyGrid],
    component: &Component,
    params: &BendParams,
    progress: &dyn Progress,
) -> Result<BentComponent, MergeError> {
    params.check()?;
    let mut bent = BentComponent { component: component.clone(), maps: Vec::new() };
    let [first, others @ ..] = &component.members[..] else { return Ok(bent) };
    let map = |index: usize| {
        let map = maps.get(index).copied();
        map.ok_or(MergeError::NoSuchMap { map: index, maps: maps.len() })
    };
    let thresholds = &params.thresholds;
    let mut straight = vec![Walls::new(map(first.map)?, &first.reference_from_map, thresholds)];
    for (place, member) in others.iter().enumerate() {
        let source = map(member.map)?;
        member.reference_from_map.check_finite()?;
        let map_from_reference = member.reference_from_map.inverse();
        let target = Walls::united(straight.iter().map(|walls| walls.moved(&map_from_reference)));
        let share = |place: usize| place as f64 / others.len() as f64;
        let progress = Stage::new(progress, share(place), share(place + 1));
        let report = onto(&target, source, params, &Stage::new(&progress, 0.0, 0.8))?;
        let map = report.is_borne_out.then(|| {
            bent.component.members[place + 1].bend_m = report.sigma_m;
            report.straightened(source, &Stage::new(&progress, 0.8, 1.0))
        });
        let map = map.transpose()?;
        let walls = map.as_ref().unwrap_or(source);
        straight.push(Walls::new(walls, &member.reference_from_map, thresholds));
        bent.maps.push(BentMap { map: member.map, report, straight: map });
    }
    Ok(bent)
}

/// [`unbend`] onto walls in the frame of the source.
fn onto(
    target: &Walls,
    source: &OccupancyGrid,
    params: &BendParams,
    progress: &dyn Progress,
) -> Result<BendReport, MergeError> {
    let source = Walls::new(source, &Se2::identity(), &params.thresholds);
    let fit = |walls: Vec<Wall>, from: f64, to: f64| {
        let progress = Stage::new(progress, from, to);
        let stride = walls.len().div_ceil(MOST_WALLS).max(1);
        let walls = walls.into_iter().step_by(stride).collect();
        Fit { target, walls, params, cell: source.resolution }.run(&progress)
    };
    let mut held = Held::default();
    let half_m = half_m(target, &source);
    for which in 0..PARTS {
        let (out, kept): (Vec<Wall>, Vec<Wall>) =
            source.points.iter().partition(|wall| part(wall.at) == which);
        let share = |done: i64| done as f64 / (PARTS + 1) as f64;
        let (warp, _) = fit(kept, share(which), share(which + 1))?;
        held.add(target, out.iter(), &warp, half_m);
    }
    let (warp, patches) = fit(source.points.clone(), 0.66, 1.0)?;
    let walls: Vec<Point2<f64>> = source.points.iter().map(|wall| wall.at).collect();
    let cell = target.resolution.max(source.resolution);
    Ok(BendReport::new(warp, patches, &held, (&walls, cell), params))
}

struct Fit<'a> {
    target: &'a Walls,
    /// Of the source.
    walls: Vec<Wall>,
    params: &'a BendParams,
    /// Metres a cell of the source.
    cell: f64,
}

impl Fit<'_> {
    /// The deformation, and how many patches it is fitted to.
    fn run(&self, progress: &dyn Progress) -> Result<(Warp, usize), MergeError> {
        let mut warp = Warp::fit(&[], &self.params.warp)?;
        let mut followed = 0;
        let mut places: Vec<Point2<f64>> = self.walls.iter().map(|wall| wall.at).collect();
        for (stage, &(side, reach, rounds)) in STAGES.iter().enumerate() {
            let patches = self.patches(side);
            for round in 0..rounds {
                let share = round as f64 / rounds as f64;
                progress.go_on((stage as f64 + share) / STAGES.len() as f64)?;
                let follow = |patch: &Vec<usize>| {
                    let walls = patch.iter().map(|&wall| (self.walls[wall], places[wall]));
                    patch::motion(self.target, &warp, walls.collect(), reach)
                };
                let motions: Vec<Motion> = patches.iter().filter_map(follow).collect();
                followed = motions.len();
                warp = Warp::fit(&motions, &self.params.warp)?;
                let moved: Vec<Point2<f64>> =
                    self.walls.iter().map(|wall| warp.apply(wall.at)).collect();
                let steps =
                    places.iter().zip(&moved).map(|(before, after)| (after - before).norm());
                let farthest = steps.fold(0.0, f64::max);
                places = moved;
                if farthest <= SETTLED_CELLS * self.cell {
                    break;
                }
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
