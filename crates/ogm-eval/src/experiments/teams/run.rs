//! X9 run: draws teams, merges them, judges every pair.

use nalgebra::Point2;
use ogm_core::{ClassThresholds, OccupancyGrid, Outcome, RelativePose, Se2};
use ogm_merge::{RobotMap, TeamParams, TeamReport, merge_team};
use ogm_sim::{FloorKind, LabelledTeam, SimError, labelled_team};
use rayon::prelude::*;

use super::record::{Answer, Judged, Pair};
use crate::judge::{PoseError, Tolerance, Truth, UNSEEN, nees};
use crate::options::Options;

/// Where the seeds of this experiment begin; those from 7 million on served to develop it.
const FIRST_SEED: u64 = 6_000_000;
/// Robots of a team.
const ROBOTS: [u64; 2] = [3, 12];
/// Wall in common from which on a pair should be placed, metres.
const ENOUGH_M: f64 = 5.0;
/// Walls nearer than this are the same wall, besides what drift bent, metres.
const SAME_WALL_M: f64 = 0.2;

pub(super) fn run(options: &Options) -> anyhow::Result<Vec<Judged>> {
    let count = options.count(1, 40);
    let first = FIRST_SEED + options.seed;
    let drawn: Vec<(FloorKind, u64)> =
        (0..count).flat_map(|index| FloorKind::ALL.map(|kind| (kind, first + index))).collect();
    options.watch.begin("X9 teams", drawn.len() as u64);
    let judged: Vec<Option<Judged>> = drawn
        .par_iter()
        .map(|&(kind, seed)| {
            let robots = robots(seed ^ kind as u64, options.quick);
            let team = labelled_team(kind, robots, (seed ^ kind as u64).is_multiple_of(2), seed);
            let judged = match team {
                Ok(team) => judge(kind, seed, &team).map(Some),
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

fn robots(draw: u64, quick: bool) -> usize {
    let most = if quick { 5 } else { ROBOTS[1] };
    let mixed = draw.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    usize::try_from(ROBOTS[0] + mixed % (most - ROBOTS[0] + 1)).unwrap_or(3)
}

fn judge(kind: FloorKind, seed: u64, team: &LabelledTeam) -> anyhow::Result<Judged> {
    let maps: Vec<RobotMap<'_>> = team.maps.iter().map(RobotMap::from).collect();
    let report = merge_team(&maps, &TeamParams::default(), &())?;
    let stranger = team.stranger();
    let pairs = report.pairs.iter().filter_map(|pair| {
        let (target, source) = (pair.target, pair.source);
        if stranger == Some(source) {
            return None;
        }
        let truth = PairJudge::of(team, target, source)?;
        let alone = match pair.report.as_ref().map(|report| &report.outcome) {
            Some(Outcome::Found(target_from_source)) => truth.answer(target_from_source),
            Some(Outcome::Refused(refusal)) => Answer::Apart(Some(refusal.clone())),
            None => Answer::Apart(None),
        };
        let joint = match &pair.target_from_source {
            Some(target_from_source) => truth.answer(target_from_source),
            None => Answer::Apart(None),
        };
        let shares_enough = truth.shared_wall_m(&team.maps[target], &team.maps[source]) >= ENOUGH_M;
        let marginal = shares_enough.then(|| marginal(&report, target, source)).flatten();
        Some(Pair {
            shares_enough,
            nees: marginal
                .filter(|_| joint.is_right())
                .and_then(|pose| nees(&pose, &truth.target_from_source)),
            alone,
            joint,
            probability: report.probability(target, source),
        })
    });
    let is_joined = |stranger: usize| {
        let with = report.components.iter().find(|found| found.pose(stranger).is_some());
        with.is_some_and(|found| found.members.len() > 1)
    };
    Ok(Judged { kind, seed, pairs: pairs.collect(), stranger: stranger.map(is_joined) })
}

/// The pose of the source in the target where that is the reference of its component.
fn marginal(report: &TeamReport, target: usize, source: usize) -> Option<RelativePose> {
    let with = report.components.iter().find(|found| found.members[0].map == target)?;
    let member = with.members.iter().find(|member| member.map == source)?;
    Some(RelativePose {
        target_from_source: member.reference_from_map,
        covariance: member.covariance?,
        probability: 1.0,
    })
}

/// What is true of a pair, whether or not its maps have anything in common.
struct PairJudge {
    target_from_source: Se2,
    /// For maps that do.
    shared: Option<(Truth, f64)>,
    /// The middle of the source.
    centre: Point2<f64>,
    cell: f64,
}

impl PairJudge {
    fn of(team: &LabelledTeam, target: usize, source: usize) -> Option<Self> {
        let [target_map, source_map] = [target, source].map(|map| &team.maps[map]);
        let poses = [target, source].map(|map| team.world_from_map[map]);
        let cell = target_map.frame().resolution();
        let truth = team.truth(target, source);
        let shared = truth.map(|truth| (Truth::of_simulated(truth, cell, false), truth.residual));
        let by_frames = poses[0]?.between(&poses[1]?);
        let target_from_source = truth.map_or(by_frames, |truth| truth.target_from_source);
        let walls = source_map.occupied_points(&ClassThresholds::default());
        let sum: nalgebra::Vector2<f64> = walls.iter().map(|point| point.coords).sum();
        let centre = Point2::from(sum / walls.len().max(1) as f64);
        Some(Self { target_from_source, shared, centre, cell })
    }

    fn answer(&self, target_from_source: &Se2) -> Answer {
        let (error, tolerance): (PoseError, Tolerance) = match &self.shared {
            Some((truth, _)) => (truth.error(target_from_source), truth.tolerance),
            None => {
                let truth = &self.target_from_source;
                (PoseError::at(self.centre, target_from_source, truth), UNSEEN)
            }
        };
        Answer::Placed { error, is_right: tolerance.admits(error, self.cell) }
    }

    /// Wall of the source that lies on wall of the target, metres.
    fn shared_wall_m(&self, target: &OccupancyGrid, source: &OccupancyGrid) -> f64 {
        let Some((_, residual)) = self.shared else { return 0.0 };
        let thresholds = ClassThresholds::default();
        let Some(walls) = ogm_core::NearestWall::new(target, &thresholds) else { return 0.0 };
        let cell = source.frame().resolution();
        // One wall may be several cells thick.
        let mut lengths = std::collections::BTreeSet::new();
        for point in source.occupied_points(&thresholds) {
            let there = self.target_from_source * point;
            if (walls.nearest_to(there) - there).norm() <= SAME_WALL_M + residual {
                let square = 0.25_f64.max(cell);
                #[expect(clippy::cast_possible_truncation, reason = "squares of a map")]
                let square = ((there.x / square).floor() as i64, (there.y / square).floor() as i64);
                lengths.insert(square);
            }
        }
        0.25_f64.max(cell) * lengths.len() as f64
    }
}
