//! Any number of robots in one plan, and the truth about their maps.

use nalgebra::{Point2, Vector2};
use ogm_core::{RobotId, Se2};
use rand::RngExt;
use std::f64::consts::PI;

use crate::draw::{Stream, generator};
use crate::explore::{Part, explore, free_space};
use crate::run::{frame_at_start, random_heading};
use crate::tags::place_tags;
use crate::{FloorPlan, PairParams, RobotRun, SimError, map_along_path};

/// Share of a floor that a robot without a route explores: any two of them meet, and none sees all.
const EXPLORED: f64 = 0.6;

/// What is asked of one robot of a team; nothing by default.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TeamMember {
    /// Where it goes, plan frame, a point every [`PairParams::step`], as from [`FloorPlan::path`].
    /// `None` is the route of the plan for the first two robots; the others explore 60 % of the
    /// floor from a random start.
    pub path: Option<Vec<Point2<f64>>>,
    /// The pose of its map frame in the plan. `None` is the start of its path, turned at random.
    pub world_from_map: Option<Se2>,
}

/// Robots that explored one plan.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedTeam {
    /// What each robot brings home, in the order of the team: robot `i` is `RobotId(i)`.
    pub robots: Vec<RobotRun>,
    /// Where the tags hang, plan frame.
    pub tags: Vec<(u32, Point2<f64>)>,
}

impl SimulatedTeam {
    /// The exact motion from the map frame of `source` into that of `target`; `None` if one of
    /// them is not in the team.
    #[must_use]
    pub fn target_from_source(&self, target: RobotId, source: RobotId) -> Option<Se2> {
        let world_from_map = |robot: RobotId| {
            let run = usize::try_from(robot.0).ok().and_then(|index| self.robots.get(index));
            run.map(|run| run.world_from_map)
        };
        Some(world_from_map(target)?.between(&world_from_map(source)?))
    }
}

/// Sends robots through `plan`; each maps in a frame of its own, at its start with a random
/// heading unless asked otherwise, so that no two lattices have anything in common.
///
/// What a robot does depends on its place in the team and on the seed, not on the others.
///
/// ```
/// use ogm_core::RobotId;
/// use ogm_sim::{FloorPlan, PairParams, TeamMember, simulate_team};
///
/// let team = vec![TeamMember::default(); 3];
/// let team = simulate_team(&FloorPlan::plan_b(), &team, &PairParams::sa())?;
/// assert!(team.target_from_source(RobotId(0), RobotId(2)).is_some());
/// # Ok::<(), ogm_sim::SimError>(())
/// ```
///
/// # Errors
/// Parameters out of range, a blocked route, a path that cannot be driven, or too little wall for
/// the tags.
pub fn simulate_team(
    plan: &FloorPlan,
    team: &[TeamMember],
    params: &PairParams,
) -> Result<SimulatedTeam, SimError> {
    params.check()?;
    let tags = place_tags(plan, &params.tags, params.seed)?;
    let run = |(robot, member): (RobotId, &TeamMember)| {
        let path = match &member.path {
            Some(path) => path.clone(),
            None if plan.route(robot).is_some() => plan.path(robot, params.step)?,
            None => explored(plan, robot, params)?,
        };
        let world_from_map = member
            .world_from_map
            .unwrap_or_else(|| frame_at_start(&path, random_heading(params.seed, robot)));
        map_along_path(plan, &path, &tags, world_from_map, robot, params)
    };
    let robots = (0..).map(RobotId).zip(team).map(run).collect::<Result<_, _>>()?;
    Ok(SimulatedTeam { robots, tags })
}

/// A path through the part of the floor on one side of a line in a random direction.
fn explored(
    plan: &FloorPlan,
    robot: RobotId,
    params: &PairParams,
) -> Result<Vec<Point2<f64>>, SimError> {
    let mut rng = generator(params.seed, Stream::Route, robot.0.into());
    let (sin, cos) = rng.random_range(-PI..PI).sin_cos();
    let space = free_space(plan)?;
    let part = Part::holding(EXPLORED, &space, Vector2::new(cos, sin));
    let middle = plan.size() / 2.0;
    let blocked = SimError::BlockedRoute { x: middle.x, y: middle.y };
    explore(&space, &part, params.step, &mut rng).ok_or(blocked)
}
