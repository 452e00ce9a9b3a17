//! What cannot be simulated.

use ogm_core::{GridError, ParameterError, RobotId};

/// A plan, route or parameter that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimError {
    /// A line of a plan that does not say what a plan can say.
    #[error("line {line} of the plan: expected {expected}")]
    PlanSyntax {
        /// Line from the top, from 1.
        line: usize,
        /// What should stand there.
        expected: &'static str,
    },
    /// A plan that looks the same after a turn: no map of it has one true pose.
    #[error(
        "the plan equals itself turned by {degrees} degrees; move a door or a piece of furniture"
    )]
    SymmetricPlan {
        /// The turn, degrees.
        degrees: u32,
    },
    /// A robot that would have to pass through a wall or too close to one.
    #[error(
        "the way of a robot is blocked near ({x:.2}, {y:.2}) m; move its way points or the wall"
    )]
    BlockedRoute {
        /// Where, metres in the plan.
        x: f64,
        /// Where, metres in the plan.
        y: f64,
    },
    /// A robot for which the plan has no route.
    #[error("the plan has routes for two robots and none for {robot}; give it a path")]
    NoRoute {
        /// Which one.
        robot: RobotId,
    },
    /// Fewer reachable walls than tags.
    #[error("only {placed} of {wanted} tags found a place on a reachable wall")]
    NoPlaceForTags {
        /// Tags placed.
        placed: usize,
        /// Tags asked for.
        wanted: usize,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No exploration of a drawn floor gave maps that overlap as asked for.
    #[error("no two parts of this floor overlap as asked for; try another seed")]
    NoSuchPair,
    /// A map that is no grid, mostly because it would be too large.
    #[error(transparent)]
    Grid(#[from] GridError),
}
