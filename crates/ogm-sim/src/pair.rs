//! Two robots in one plan, and the truth about their maps.

use nalgebra::Point2;
use ogm_core::{GridError, Se2, warp_nearest};

use crate::{FloorPlan, PairParams, RobotRun, SimError, TeamMember, simulate_team};

/// Two robots that explored one plan.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedPair {
    /// The robot whose frame is kept.
    pub target: RobotRun,
    /// The robot whose map is to be moved.
    pub source: RobotRun,
    /// The exact motion from the source's map frame into the target's.
    pub target_from_source: Se2,
    /// Where the tags hang, plan frame.
    pub tags: Vec<(u32, Point2<f64>)>,
}

impl SimulatedPair {
    /// Share of what one robot observed that the other did as well: cells that both observed,
    /// over the mean of what each did.
    ///
    /// # Errors
    /// None for a pair that [`simulate_pair`] made.
    pub fn overlap(&self) -> Result<f64, GridError> {
        let target = &self.target;
        let warped = warp_nearest(
            &self.source.coverage,
            self.source.map.frame(),
            target.map.frame(),
            (target.map.width(), target.map.height()),
            &self.target_from_source,
            false,
        )?;
        let count = |cells: &[bool]| cells.iter().filter(|&&seen| seen).count() as f64;
        let area =
            |run: &RobotRun| count(run.coverage.cells()) * run.map.frame().resolution().powi(2);
        let pairs = target.coverage.cells().iter().zip(warped.cells());
        let both = pairs.filter(|&(&a, &b)| a && b).count() as f64;
        let shared = both * target.map.frame().resolution().powi(2);
        Ok(2.0 * shared / (area(target) + area(&self.source)))
    }
}

/// Sends two robots along the routes of `plan`: [`simulate_team`] of two that go their own way.
///
/// # Panics
/// Never: two robots come back.
///
/// # Errors
/// Parameters out of range, a blocked route, or too little wall for the tags.
pub fn simulate_pair(plan: &FloorPlan, params: &PairParams) -> Result<SimulatedPair, SimError> {
    let [target, source] = [TeamMember::default(), TeamMember::default()];
    let team = simulate_team(plan, &[target, source], params)?;
    let tags = team.tags;
    let [target, source] = <[RobotRun; 2]>::try_from(team.robots).expect("a team of two");
    let target_from_source = target.world_from_map.between(&source.world_from_map);
    Ok(SimulatedPair { target, source, target_from_source, tags })
}
