//! Input that cannot be meant.

use ogm_core::GridError;

/// Input to a recipe that cannot be meant.
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
    /// The maps or parameters of the segment and Radon method.
    #[error(transparent)]
    Radon(#[from] radon_merge::RadonError),
}
