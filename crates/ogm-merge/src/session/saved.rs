//! A session as plain data, to go on with after a restart.

use nalgebra::Matrix3;
use ogm_core::{Grid, GridError, GridFrame, Occupancy, OccupancyGrid, RelativePose, Se2};

use super::group::Standing;
use super::pairs::Progressed;
use super::params::RobotPrior;
use super::resume_error::ResumeError;
use super::robot::Robot;
use crate::team::{Matched, Proposal};

/// Everything that a [`MergeSession`](crate::MergeSession) knows, but its parameters. With the
/// feature `serde` it is written and read in any format.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedSession {
    pub(crate) version: u32,
    pub(crate) robots: Vec<SavedRobot>,
    pub(crate) pairs: Vec<SavedPair>,
    pub(crate) groups: Vec<Vec<SavedStanding>>,
}

#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SavedRobot {
    name: String,
    /// `world_from_map` and its standard deviations.
    prior: Option<([f64; 3], [f64; 2])>,
    separated: bool,
    revision: u64,
    changed: f64,
    resolution: f64,
    map_from_grid: [f64; 3],
    width: usize,
    height: usize,
    /// Bytes of cells, and how often each follows.
    cells: Vec<(u8, u32)>,
}

#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SavedPair {
    pub(crate) target: usize,
    pub(crate) source: usize,
    /// Revision and changes of target and source.
    at: [(u64, f64); 2],
    proposals: Vec<SavedProposal>,
}

#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct SavedProposal {
    target_from_source: [f64; 3],
    covariance: [[f64; 3]; 3],
    probability: f64,
    score: f64,
    bend_m: f64,
}

#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SavedStanding {
    pub(crate) map: usize,
    group_from_map: [f64; 3],
    covariance: Option<[[f64; 3]; 3]>,
    bend_m: f64,
    probability: f64,
}

impl SavedRobot {
    pub(crate) fn new(robot: &Robot, map: &OccupancyGrid) -> Self {
        let mut cells: Vec<(u8, u32)> = Vec::new();
        for cell in map.cells().cells() {
            match cells.last_mut() {
                Some((byte, count)) if *byte == cell.byte() && *count < u32::MAX => *count += 1,
                _ => cells.push((cell.byte(), 1)),
            }
        }
        Self {
            name: robot.name.clone(),
            prior: robot
                .prior
                .map(|prior| (numbers(&prior.world_from_map), [prior.sigma_m, prior.sigma_rad])),
            separated: robot.is_separated,
            revision: robot.at.revision,
            changed: robot.at.changed,
            resolution: map.frame().resolution(),
            map_from_grid: numbers(&map.frame().map_from_grid()),
            width: map.width(),
            height: map.height(),
            cells,
        }
    }

    pub(crate) fn resumed(self) -> Result<(Robot, OccupancyGrid), ResumeError> {
        let map = self.map().map_err(|why| ResumeError::Map { robot: self.name.clone(), why })?;
        let prior = self.prior.map(|(world_from_map, [sigma_m, sigma_rad])| RobotPrior {
            world_from_map: pose(world_from_map),
            sigma_m,
            sigma_rad,
        });
        if prior.is_some_and(|prior| prior.check().is_err()) {
            return Err(ResumeError::Inconsistent("a prior that is no pose"));
        }
        let at = Progressed { revision: self.revision, changed: self.changed };
        Ok((Robot { name: self.name, prior, is_separated: self.separated, at }, map))
    }

    fn map(&self) -> Result<OccupancyGrid, GridError> {
        let frame = GridFrame::new(self.resolution, pose(self.map_from_grid))?;
        // Sizes that do not agree with the runs are found before anything is allocated by them.
        let counted: u64 = self.cells.iter().map(|(_, count)| u64::from(*count)).sum();
        let wanted = ogm_core::cell_count(self.width, self.height)?;
        let runs = if counted == wanted as u64 { &self.cells[..] } else { &[] };
        let cells = runs.iter().flat_map(|&(byte, count)| {
            std::iter::repeat_n(Occupancy::from_byte(byte), count as usize)
        });
        Ok(OccupancyGrid::new(frame, Grid::new(self.width, self.height, cells.collect())?))
    }
}

impl SavedPair {
    pub(crate) fn new(pair: &Matched, at: &[Progressed; 2]) -> Self {
        let proposal = |found: &Proposal| SavedProposal {
            target_from_source: numbers(&found.pose.target_from_source),
            covariance: rows(&found.pose.covariance),
            probability: found.pose.probability,
            score: found.score,
            bend_m: found.bend_m,
        };
        Self {
            target: pair.target,
            source: pair.source,
            at: at.map(|at| (at.revision, at.changed)),
            proposals: pair.proposals.iter().map(proposal).collect(),
        }
    }

    pub(crate) fn resumed(&self) -> (Matched, [Progressed; 2]) {
        let proposal = |saved: &SavedProposal| Proposal {
            pose: RelativePose {
                target_from_source: pose(saved.target_from_source),
                covariance: matrix(&saved.covariance),
                probability: saved.probability,
            },
            score: saved.score,
            bend_m: saved.bend_m,
        };
        let proposals = self.proposals.iter().map(proposal).collect();
        let at = self.at.map(|(revision, changed)| Progressed { revision, changed });
        (Matched { target: self.target, source: self.source, proposals }, at)
    }
}

impl SavedStanding {
    pub(crate) fn new(standing: &Standing) -> Self {
        Self {
            map: standing.map,
            group_from_map: numbers(&standing.group_from_map),
            covariance: standing.covariance.as_ref().map(rows),
            bend_m: standing.bend_m,
            probability: standing.probability,
        }
    }

    pub(crate) fn resumed(&self) -> Standing {
        Standing {
            map: self.map,
            group_from_map: pose(self.group_from_map),
            covariance: self.covariance.as_ref().map(matrix),
            bend_m: self.bend_m,
            probability: self.probability,
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.group_from_map.iter().all(|number| number.is_finite())
    }
}

fn numbers(target_from_source: &Se2) -> [f64; 3] {
    [target_from_source.x(), target_from_source.y(), target_from_source.theta()]
}

fn pose([x, y, theta]: [f64; 3]) -> Se2 {
    Se2::new(x, y, theta)
}

fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}
