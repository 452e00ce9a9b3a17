//! X8 run: drives the robots, filters their logs, lets them share their maps.

use nalgebra::Point2;
use ogm_core::RobotId;
use ogm_sim::{FloorPlan, SOURCE, SensorParams, TARGET, record_sensors};
use rayon::prelude::*;

use super::filters::{judge, track};
use super::record::{Filter, Team};
use super::teams::{Sharer, share};
use crate::options::Options;

/// Where the seeds of this experiment begin; those from 9 million on served to develop it.
const FIRST_SEED: u64 = 8_000_000;
/// Times that the robots share their maps.
const SHARES: usize = 3;
/// Metres between the points of a path.
const PATH_STEP: f64 = 0.03;

pub(super) fn run(options: &Options) -> anyhow::Result<Vec<Team>> {
    let count = options.count(2, 20);
    let first = FIRST_SEED + options.seed;
    options.watch.begin("X8 teams", count);
    let teams = (0..count).into_par_iter().map(|index| {
        let team = drive(first + index);
        options.watch.step();
        team
    });
    let teams = teams.collect();
    options.watch.end();
    teams
}

fn drive(seed: u64) -> anyhow::Result<Team> {
    let plan = FloorPlan::plan_b();
    let params = SensorParams { seed, ..SensorParams::sa() };
    let (first, second) = (plan.path(TARGET, PATH_STEP)?, plan.path(SOURCE, PATH_STEP)?);
    // The third robot drives the later part of the first one's way, backwards.
    let third: Vec<Point2<f64>> = first[first.len() / 3..].iter().rev().copied().collect();
    let mut robots = Vec::new();
    let mut sharers = Vec::new();
    for (path, robot) in [first, second, third].iter().zip(0..) {
        let log = record_sensors(&plan, path, RobotId(robot), &params)?;
        let [a, b, c] = Filter::ALL.map(|filter| track(filter, &log, &params));
        let tracks = [a?, b?, c?];
        robots.push(judge(&log, &tracks));
        let [_, _, by_scans] = tracks;
        sharers.push(Sharer { log, start_from_robot: by_scans.start_from_robot });
    }
    let shares =
        (1..=SHARES).map(|part| share(&plan, &sharers, part as f64 / SHARES as f64, &params));
    let shares = shares.collect::<anyhow::Result<_>>()?;
    Ok(Team { seed, robots, shares })
}
