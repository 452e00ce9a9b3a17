//! Input that cannot be meant, and calls that were ended.

use ogm_core::{Cancelled, GridError, ParameterError};

/// Why a call gave no report: input that cannot be meant, or a cancelled call.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MergeError {
    /// A grid or frame.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A tag reading.
    #[error(transparent)]
    Tags(#[from] rfid_loc::TagError),
    /// The start or the points of the refinement.
    #[error(transparent)]
    Refinement(#[from] icp2d::IcpError),
    /// The start or the parameters of the random walk.
    #[error(transparent)]
    Walk(#[from] carpin_walk::WalkError),
    /// The fusion.
    #[error(transparent)]
    Fusion(#[from] grid_merge::FusionError),
    /// The search for a transform.
    #[error(transparent)]
    Matching(#[from] grid_match::MatchError),
    /// The joint poses of a team.
    #[error(transparent)]
    Graph(#[from] pose_graph2d::GraphError),
    /// The maps or parameters of the segment and Radon method.
    #[error(transparent)]
    Radon(#[from] radon_merge::RadonError),
    /// A component of maps that were not handed in.
    #[error("a component names map {map}, counted from 0, where there are {maps} maps")]
    NoSuchMap {
        /// Which map.
        map: usize,
        /// How many there are.
        maps: usize,
    },
    /// Known poses that are not one for each map.
    #[error("{poses} poses for {maps} maps; each map needs one, and there must be a map")]
    PosesOfMaps {
        /// How many poses there are.
        poses: usize,
        /// How many maps.
        maps: usize,
    },
    /// A robot that a session was never told of.
    #[error("no robot '{name}' in this session")]
    NoSuchRobot {
        /// What it was called.
        name: String,
    },
    /// Saved data that is no session.
    #[error(transparent)]
    Resume(#[from] crate::session::ResumeError),
    /// A parameter outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The call was asked to end.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl MergeError {
    /// Whether the call was asked to end, at whatever stage it was.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_)
                | Self::Walk(carpin_walk::WalkError::Cancelled(_))
                | Self::Fusion(grid_merge::FusionError::Cancelled(_))
                | Self::Matching(grid_match::MatchError::Cancelled(_))
                | Self::Graph(pose_graph2d::GraphError::Cancelled(_))
                | Self::Radon(radon_merge::RadonError::Cancelled(_))
                | Self::Tags(rfid_loc::TagError::Cancelled(_))
        )
    }
}
