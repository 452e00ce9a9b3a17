//! What is kept of a team of X8.

use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Refusal};

use crate::judge::{PoseError, TransformError};
use crate::measured::{Run, RunResult};

/// How a robot places itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Filter {
    DeadReckoning,
    Ekf,
    EkfWithScans,
}

impl Filter {
    pub(super) const ALL: [Self; 3] = [Self::DeadReckoning, Self::Ekf, Self::EkfWithScans];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::DeadReckoning => "dead reckoning",
            Self::Ekf => "EKF",
            Self::EkfWithScans => "EKF with scans",
        }
    }
}

/// One robot's run under every filter.
#[derive(Debug, Clone)]
pub(super) struct Robot {
    /// Metres driven.
    pub(super) length: f64,
    /// In the order of [`Filter::ALL`].
    pub(super) ends: [End; 3],
    /// True path in the plan, and that of every filter laid from the true start.
    pub(super) paths: [Vec<Point2<f64>>; 4],
}

impl Robot {
    pub(super) fn end(&self, filter: Filter) -> &End {
        &self.ends[filter as usize]
    }
}

/// The last pose of a filter, beside the truth.
#[derive(Debug, Clone)]
pub(super) struct End {
    pub(super) error: PoseError,
    pub(super) nees: Option<f64>,
    /// Scan matches used, gated, and refused by ICP.
    pub(super) scans: [usize; 3],
}

/// Three robots.
#[derive(Debug, Clone)]
pub(super) struct Team {
    pub(super) seed: u64,
    pub(super) robots: Vec<Robot>,
    /// What came of each sharing, in order.
    pub(super) shares: Vec<Share>,
}

/// The maps of one moment, fused in the frame of the first.
#[derive(Debug, Clone)]
pub(super) struct Share {
    /// Of the second and the third robot.
    pub(super) placed: Vec<Placed>,
    pub(super) fused: OccupancyGrid,
    /// Wall cells of the fused map, and those near a wall of the plan.
    pub(super) walls: usize,
    pub(super) right_walls: usize,
}

impl Share {
    /// Percent of the walls that are right.
    pub(super) fn right_percent(&self) -> f64 {
        100.0 * self.right_walls as f64 / self.walls as f64
    }
}

/// What came of one map.
#[derive(Debug, Clone)]
pub(super) enum Placed {
    Refused(Refusal),
    Found { error: PoseError, is_right: bool, verification: f64 },
}

impl Placed {
    pub(super) fn is_right(&self) -> bool {
        matches!(self, Self::Found { is_right: true, .. })
    }

    pub(super) fn is_wrong(&self) -> bool {
        matches!(self, Self::Found { is_right: false, .. })
    }
}

/// The rows of a team: the last pose of every robot under every filter, and every placed map.
pub(super) fn rows(team: &Team) -> Vec<Run> {
    let run = |case: String, variant: &str, result| Run {
        experiment: "X8",
        case,
        variant: variant.to_owned(),
        seed: team.seed,
        result,
    };
    let of_pose = |error| RunResult::Transform(TransformError::over_area(error));
    let mut rows = Vec::new();
    for (index, robot) in team.robots.iter().enumerate() {
        for filter in Filter::ALL {
            let error = robot.end(filter).error;
            rows.push(run(format!("robot {}", index + 1), filter.name(), of_pose(error)));
        }
    }
    for (share, moment) in team.shares.iter().zip(1..) {
        for (placed, map) in share.placed.iter().zip(2..) {
            let result = match placed {
                Placed::Refused(refusal) => RunResult::Refused(refusal.clone()),
                Placed::Found { error, .. } => of_pose(*error),
            };
            rows.push(run(format!("share {moment}, map {map}"), "radon", result));
        }
    }
    rows
}
