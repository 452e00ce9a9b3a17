//! A bent map made straight: motions of patches and a smooth deformation, in turns, believed where
//! walls that were held out of the fit say so.

mod buckets;
mod fit;
mod held_out;
mod params;
mod patch;
mod report;
mod walls;

use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Progress, Se2, Stage, Steps};

use crate::MergeError;
use crate::merge::Component;
use crate::parallel::{both, map_in_order};

use self::fit::{Fit, MOST_ROUNDS};
use self::held_out::{Held, PARTS, half_m, part};
use self::walls::{Wall, Walls};

pub use self::params::BendParams;
pub use self::report::{BendReport, BentComponent, BentMap};

/// Bends `source`, which lies on `target` at `target_from_source`, so that its walls lie on those
/// of `target` as far as drift can have moved them.
///
/// Patches of the source follow the walls of the target; a smooth deformation without folds
/// ([`map_warp::Warp`]) is fitted to their motions, and from where it puts them they follow again,
/// first in patches the size of a hall, then of a room. The same is done twice with half of the
/// walls, squares of a chessboard of 1 m; whether the other half then lies better than under any
/// rigid motion decides whether the bend is believed ([`BendReport::is_borne_out`]). The pose stays
/// what it is: the deformation leads from the source map to the same frame.
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
    let parts: Vec<i64> = (0..PARTS).collect();
    let steps = Steps::new(progress, MOST_ROUNDS * (parts.len() + 1));
    let fit = |walls: Vec<Wall>| Fit::new(target, walls, source.resolution).run(params, &steps);
    let without = |&which: &i64| {
        let kept = source.points.iter().filter(|wall| part(wall.at) != which);
        fit(kept.copied().collect())
    };
    let (without, all) = both(|| map_in_order(&parts, without), || fit(source.points.clone()));
    let mut held = Held::default();
    let half_m = half_m(target, &source);
    for (which, fit) in parts.into_iter().zip(without) {
        let out = source.points.iter().filter(|wall| part(wall.at) == which);
        held.add(target, out, &fit?.0, half_m);
    }
    let (warp, patches) = all?;
    let walls: Vec<Point2<f64>> = source.points.iter().map(|wall| wall.at).collect();
    let cell = target.resolution.max(source.resolution);
    Ok(BendReport::new(warp, patches, &held, (&walls, cell), params))
}
