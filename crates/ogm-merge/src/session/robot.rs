//! One robot of a session: what it sent, and where it stands.

use grid_match::{PreparedMap, pose_probabilities, score_pose};
use nalgebra::Matrix3;
use ogm_core::{ClassThresholds, OccupancyGrid, Se2};

use super::pairs::Progressed;
use super::params::RobotPrior;
use crate::MergeError;

/// A map with less wall cannot show that its frame changed, metres.
const TELLING_M: f64 = 5.0;

/// What a session knows about a robot beside its map.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Robot {
    pub(crate) name: String,
    pub(crate) prior: Option<RobotPrior>,
    /// Somebody said that it belongs nowhere.
    pub(crate) is_separated: bool,
    pub(crate) at: Progressed,
}

impl Robot {
    pub(crate) fn new(name: &str) -> Self {
        let at = Progressed { revision: 1, changed: 0.0 };
        Self { name: name.to_owned(), prior: None, is_separated: false, at }
    }
}

/// Where a robot's map stands in a session.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotState {
    /// The robot.
    pub name: String,
    /// Its place in the world; `None` as long as nobody is sure enough of one.
    pub placement: Option<Placement>,
    /// The robots whose maps hang together with it.
    pub with: Vec<String>,
    /// The robot whose map it matches best by the two maps alone, and the probability of that;
    /// `None` if no pair of its has been searched.
    pub best_match: Option<(String, f64)>,
    /// Whether [`separate`](crate::MergeSession::separate) holds it apart.
    pub is_separated: bool,
}

/// A map's place in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Maps its points into the world.
    pub world_from_map: Se2,
    /// Covariance of (x, y, θ) in the axes of the world, m², m·rad, rad²; zero for the map that
    /// holds the frame, `None` where no chain of pairs says one.
    pub covariance: Option<Matrix3<f64>>,
    /// Probability that it lies there; 1 for the map that holds the frame, and where it was given.
    pub probability: f64,
}

/// Share of what `new` knows that is not what `old` said there, in [0, 1].
pub(crate) fn changed_share(
    old: &OccupancyGrid,
    new: &OccupancyGrid,
    thresholds: &ClassThresholds,
) -> f64 {
    let (mut known, mut changed) = (0_usize, 0_usize);
    for (index, &cell) in new.cells().indexed().filter(|(_, cell)| cell.is_known()) {
        let before = old.at(new.frame().cell_centre(index));
        known += 1;
        changed += usize::from(thresholds.classify(before) != thresholds.classify(cell));
    }
    if known == 0 { 1.0 } else { changed as f64 / known as f64 }
}

/// Whether the walls of `new` are where those of `old` were, as far as there are enough to tell.
pub(crate) fn is_same_frame(old: &PreparedMap, new: &PreparedMap) -> Result<bool, MergeError> {
    if old.wall_length() < TELLING_M {
        return Ok(true);
    }
    let score = score_pose(old, new, &Se2::identity())?.score();
    Ok(pose_probabilities(&[score], false).first().is_some_and(|&probability| probability >= 0.5))
}
