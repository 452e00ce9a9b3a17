//! Three robots share the maps that they have so far, and the first one fuses them.

use grid_merge::FusionParams;
use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, Se2};
use ogm_merge::merge_by_radon;
use ogm_sim::{FloorPlan, MappingParams, SensorLog, SensorParams, map_scans};
use radon_merge::RadonParams;

use super::record::{Placed, Share};
use crate::judge::{Truth, UNSEEN};

/// Metres a cell; the paper prints none.
const CELL: f64 = 0.05;
/// Robots that came this near to each other's way saw the same walls, metres.
const SAME_PLACE_M: f64 = 1.0;
/// A wall of the fused map is right this near to one of the plan, metres: as drift of a decimetre
/// and a cell put it.
const RIGHT_WALL_M: f64 = 0.15;

/// A robot that shares its map.
pub(super) struct Sharer {
    pub(super) log: SensorLog,
    /// Where its filter believes it to be, at the start and after every sample.
    pub(super) start_from_robot: Vec<Se2>,
}

impl Sharer {
    /// The true pose in the plan, the believed one in its map, and what was seen, of every scan in
    /// `part` of its way.
    fn scans(&self, part: f64) -> impl Iterator<Item = (Se2, Se2, &[f64])> {
        let first = (self.log.world_from_start, Some(&self.log.first_ranges));
        let after = self.log.samples.iter();
        let after = after.map(|sample| (sample.world_from_robot, sample.ranges.as_ref()));
        std::iter::once(first)
            .chain(after)
            .zip(&self.start_from_robot)
            .take(samples(part, self.log.samples.len()))
            .filter_map(|((truth, ranges), &believed)| Some((truth, believed, ranges?.as_slice())))
    }

    /// Its map after `part` of its way.
    fn map(&self, part: f64, params: &SensorParams) -> anyhow::Result<OccupancyGrid> {
        let scans: Vec<(Se2, &[f64])> =
            self.scans(part).map(|(_, believed, ranges)| (believed, ranges)).collect();
        let mapping = MappingParams { resolution: CELL, ..MappingParams::default() };
        Ok(map_scans(&scans, &mapping, &params.lidar)?)
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count")]
fn samples(part: f64, of: usize) -> usize {
    1 + (part * of as f64) as usize
}

/// How the map of `other` lies in that of `first` where both were: drift bends both.
fn truth(first: &Sharer, other: &Sharer, part: f64) -> Truth {
    let here: Vec<(Se2, Se2, &[f64])> = first.scans(part).collect();
    let place = |(world_from_other, in_other, _): (Se2, Se2, &[f64])| {
        let at = Point2::from(world_from_other.translation());
        let distance = |world_from_robot: &Se2| (world_from_robot.translation() - at.coords).norm();
        let near = here.iter().min_by(|a, b| distance(&a.0).total_cmp(&distance(&b.0)));
        let (world_from_first, in_first, _) = near?;
        let in_map = *in_first * (world_from_first.inverse() * at);
        let is_near = distance(world_from_first) <= SAME_PLACE_M;
        is_near.then(|| [in_map, Point2::from(in_other.translation())])
    };
    let places: Vec<[Point2<f64>; 2]> = other.scans(part).filter_map(place).collect();
    Truth::of_places(&places, CELL).unwrap_or(Truth {
        target_from_source: first.log.world_from_start.between(&other.log.world_from_start),
        centre: Point2::origin(),
        radius: 0.0,
        cell: CELL,
        tolerance: UNSEEN,
        exact: false,
    })
}

/// All share their maps after `part` of their way.
pub(super) fn share(
    plan: &FloorPlan,
    robots: &[Sharer],
    part: f64,
    params: &SensorParams,
) -> anyhow::Result<Share> {
    let maps: Vec<OccupancyGrid> =
        robots.iter().map(|robot| robot.map(part, params)).collect::<anyhow::Result<_>>()?;
    let [first, others @ ..] = maps.as_slice() else { anyhow::bail!("no robots") };
    let others: Vec<&OccupancyGrid> = others.iter().collect();
    let team = merge_by_radon(
        first,
        &others,
        &RadonParams { seed: params.seed, ..RadonParams::default() },
        &FusionParams::default(),
        &(),
    )?;
    let placed = team.matches.iter().zip(&robots[1..]).map(|(found, robot)| match &found.outcome {
        Outcome::Refused(refusal) => Placed::Refused(refusal.clone()),
        Outcome::Found(first_from_other) => {
            let truth = truth(&robots[0], robot, part);
            let error = truth.error(first_from_other);
            let accepted = found.accepted.and_then(|place| found.candidates.get(place));
            let index = accepted.and_then(|one| one.verification.index);
            Placed::Found {
                error,
                is_right: truth.admits(error),
                verification: index.unwrap_or(f64::NAN),
            }
        }
    });
    let placed = placed.collect();
    let world_from_first = robots[0].log.world_from_start;
    let fused = team.merged.map;
    let walls = fused.occupied_points(&ClassThresholds::default());
    let is_right =
        |at: &&Point2<f64>| plan.distance_to_face(world_from_first * **at) <= RIGHT_WALL_M;
    let right_walls = walls.iter().filter(is_right).count();
    Ok(Share { placed, walls: walls.len(), right_walls, fused })
}
