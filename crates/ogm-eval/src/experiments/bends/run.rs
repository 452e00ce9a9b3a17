//! X10 run: draws bent pairs, merges them, makes them straight, judges both.

use std::path::Path;

use grid_merge::fusion_quality;
use nalgebra::Point2;
use ogm_core::{ClassThresholds, NearestWall, OccupancyGrid, Outcome, Se2};
use ogm_merge::{
    AlignParams, BendParams, Component, FusionParams, Method, RobotMap, align_pair, fuse, placed,
    unbend_component,
};
use ogm_sim::{FloorKind, LabelledPair, SimError, bent_pair};
use rayon::prelude::*;

use super::known::{self, Shown, residual};
use super::record::{Bent, Judged, Real};
use crate::cases::map_pair::{MapPair, read_pairs};
use crate::judge::Truth;
use crate::options::Options;

/// Where the seeds of this experiment begin; those below a thousand served to develop it.
const FIRST_SEED: u64 = 8_000_000;
/// Standard deviations of the bends an axis, metres.
pub(super) const BENDS: [f64; 6] = [0.0, 0.1, 0.2, 0.35, 0.6, 1.0];
/// Walls of two maps nearer than this may be one wall that lies twice, metres.
const DOUBLED_M: f64 = 0.5;
/// And than this are one, cells of the coarser map.
const SAME_CELLS: f64 = 1.5;

pub(super) fn run(options: &Options) -> anyhow::Result<Vec<Judged>> {
    let count = options.count(2, 30);
    let first = FIRST_SEED + options.seed;
    let kinds = || FloorKind::ALL.into_iter().filter(|kind| !kind.repeats());
    let drawn: Vec<(f64, FloorKind, u64)> = (0..count)
        .flat_map(|index| kinds().map(move |kind| (kind, first + index)))
        .flat_map(|(kind, seed)| BENDS.map(|bend| (bend, kind, seed)))
        .collect();
    options.watch.begin("X10 bends", drawn.len() as u64);
    let judged: Vec<Option<Judged>> = drawn
        .par_iter()
        .map(|&(bend, kind, seed)| {
            let of_target = if seed.is_multiple_of(3) { bend } else { 0.0 };
            let judged = match bent_pair(kind, [of_target, bend], seed) {
                Ok(pair) => judge(bend, &pair),
                Err(SimError::NoSuchPair | SimError::BlockedRoute { .. }) => Ok(None),
                Err(error) => Err(error.into()),
            };
            options.watch.step();
            judged
        })
        .collect::<anyhow::Result<_>>()?;
    options.watch.end();
    Ok(judged.into_iter().flatten().collect())
}

fn judge(bend: f64, pair: &LabelledPair) -> anyhow::Result<Option<Judged>> {
    let Some((truth, in_target)) = pair.truth.zip(pair.bend.as_ref()) else { return Ok(None) };
    let cell = pair.target.frame().resolution().max(pair.source.frame().resolution());
    let mut judged = Judged { bend, overlap: truth.overlap, styles: pair.styles, cell, bent: None };
    let maps = [&pair.target, &pair.source];
    let judge = Truth::of_simulated(&truth, pair.target.frame().resolution(), pair.exact);
    let Some((component, pose)) = merged_rightly(maps, &judge)? else { return Ok(Some(judged)) };
    let straight = unbend_component(&maps, &component, &BendParams::default(), &())?;
    let Some(bent) = straight.maps.first() else { return Ok(Some(judged)) };
    let thresholds = ClassThresholds::default();
    let Some(target) = NearestWall::new(&pair.target, &thresholds) else { return Ok(Some(judged)) };
    let is_applied = bent.straight.is_some();
    let moved = |wall: Point2<f64>| if is_applied { bent.report.warp.apply(wall) } else { wall };
    let walls = pair.source.occupied_points(&thresholds).into_iter();
    let shown: Vec<Shown> = walls
        .filter_map(|wall| {
            let in_target = in_target.in_target(wall)?;
            let is_shown = (target.nearest_to(in_target) - in_target).norm() <= SAME_CELLS * cell;
            is_shown.then(|| Shown { wall, belongs: pose.inverse() * in_target })
        })
        .collect();
    if !shown.is_empty() {
        let known = known::warp(&shown)?;
        let share = |map: &OccupancyGrid| {
            let (doubled, walls) = doubled(&target, map, &pose, cell);
            doubled as f64 / walls.max(1) as f64
        };
        judged.bent = Some(Bent {
            is_applied,
            before_m: residual(&shown, |wall| wall),
            after_m: residual(&shown, moved),
            known_m: residual(&shown, |wall| known.apply(wall)),
            doubled_before: share(&pair.source),
            doubled_after: share(bent.straight.as_ref().unwrap_or(&pair.source)),
            moved_m: if is_applied { bent.report.rms_m } else { 0.0 },
        });
    }
    Ok(Some(judged))
}

/// The maps together at the pose that the matcher finds, where that is right.
fn merged_rightly(
    maps: [&OccupancyGrid; 2],
    truth: &Truth,
) -> anyhow::Result<Option<(Component, Se2)>> {
    let [target, source] = maps.map(RobotMap::from);
    let report = align_pair(Method::Match, &target, &source, &AlignParams::default(), &())?;
    let Outcome::Found(target_from_source) = report.outcome else { return Ok(None) };
    let is_right = truth.admits(truth.error(&target_from_source));
    let component = report.components().into_iter().next().filter(|_| is_right);
    Ok(component.map(|component| (component, target_from_source)))
}

/// Wall cells of `source` that lie beside a wall of the target and on none, and all.
fn doubled(
    target: &NearestWall,
    source: &OccupancyGrid,
    target_from_source: &Se2,
    cell: f64,
) -> (usize, usize) {
    let walls = source.occupied_points(&ClassThresholds::default());
    let is_doubled = |wall: &&Point2<f64>| {
        let place = *target_from_source * **wall;
        let apart = (target.nearest_to(place) - place).norm();
        apart > SAME_CELLS * cell && apart <= DOUBLED_M
    };
    (walls.iter().filter(is_doubled).count(), walls.len())
}

/// The pairs below `folder` that are merged rightly.
pub(super) fn real(options: &Options, folder: &Path) -> anyhow::Result<Vec<Real>> {
    let pairs = read_pairs(folder)?;
    options.watch.begin("X10 pairs", pairs.len() as u64);
    let judged: Vec<Option<Real>> = pairs
        .par_iter()
        .map(|pair| {
            let judged = pair.truth.as_ref().map_or(Ok(None), |truth| judge_real(pair, truth));
            options.watch.step();
            judged
        })
        .collect::<anyhow::Result<_>>()?;
    options.watch.end();
    Ok(judged.into_iter().flatten().collect())
}

fn judge_real(pair: &MapPair, truth: &Truth) -> anyhow::Result<Option<Real>> {
    let maps = [&pair.target, &pair.source];
    let Some((component, pose)) = merged_rightly(maps, truth)? else { return Ok(None) };
    let thresholds = ClassThresholds::default();
    let bent = unbend_component(&maps, &component, &BendParams::default(), &())?;
    let Some((one, target)) = bent.maps.first().zip(NearestWall::new(&pair.target, &thresholds))
    else {
        return Ok(None);
    };
    let cell = pair.target.frame().resolution().max(pair.source.frame().resolution());
    let straight = bent.straight(&maps);
    let lost = |maps: &[&OccupancyGrid], component: &Component| {
        let merged = fuse(maps, component, &FusionParams::default(), &())?;
        anyhow::Ok(fusion_quality(&placed(maps, component)?, &merged, &thresholds)?.lost())
    };
    Ok(Some(Real {
        name: pair.name.clone(),
        is_applied: one.straight.is_some(),
        score: one.report.score,
        moved_m: one.report.rms_m,
        max_m: one.report.max_m,
        doubled_before: doubled(&target, &pair.source, &pose, cell).0,
        doubled_after: doubled(&target, straight[1], &pose, cell).0,
        lost_before: lost(&maps, &component)?,
        lost_after: lost(&straight, &bent.component)?,
    }))
}
