//! What makes an answer less sure than it looks.

use ogm_core::Refusal;

/// What makes an answer less sure than it looks.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// The maps place the tags at different distances from each other.
    #[error("the maps disagree about the distances between tags: one may have been moved")]
    TagsMismatch,
    /// The walls of one map have no common direction.
    #[error("the walls of one map are hardly rectangular")]
    WeakWalls,
    /// One map has walls of a single direction.
    #[error("one map has walls of a single direction")]
    SingleWallDirection,
    /// Tags and walls differ by more than 20 degrees.
    #[error("tags and walls differ by more than 20 degrees")]
    QuadrantResidual,
    /// The walls' direction was of no use, so the refinement started from the tags alone.
    #[error("the walls gave no direction that holds, so the tags alone were refined")]
    StartedFromTags,
    /// The common walls leave one direction open.
    #[error(
        "the common walls leave one direction open, as in a corridor; along it the tags decide"
    )]
    Unobservable,
    /// The refinement did not settle.
    #[error("the refinement did not settle within its iterations")]
    NotSettled,
    /// The refinement could not improve on its start.
    #[error("the refinement could not improve on its start, which was kept")]
    NotImproved,
    /// Readings that no such reader gives were left out.
    #[error(
        "{dropped} of {readings} tag readings are none that the reader gives (below 0, beyond its range, not finite), and were left out"
    )]
    ReadingsDropped {
        /// How many, in both maps.
        dropped: usize,
        /// Of how many.
        readings: usize,
    },
    /// The tags that there are gave no answer, so the maps were matched without them.
    #[error("the maps were matched without their tags: {0}")]
    WithoutTags(Refusal),
    /// The tags gave the answer, and a prior has no use there.
    #[error("the tags suffice, so the prior was not used; the method `match` uses it")]
    PriorUnused,
    /// Parts of the maps lie as if one of them were longer.
    #[error(
        "the source is {:.1} % shorter than the target along its x and {:.1} % along its y: check its resolution",
        100.0 * stretch[0],
        100.0 * stretch[1]
    )]
    Stretched {
        /// Change of length along x and y of the source, over its length.
        stretch: [f64; 2],
    },
    /// The maps have too little in common in a pose that was given.
    #[error(
        "in the pose that was given the maps have too little in common to tell whether it is right"
    )]
    GivenPoseUnchecked,
    /// What the maps have in common speaks against a pose that was given.
    #[error(
        "the walls speak against the pose that was given: {:.0} % of those that both maps saw agree",
        100.0 * agreement
    )]
    GivenPoseDoubtful {
        /// Share of the compared wall that fits.
        agreement: f64,
    },
    /// Both maps hold the same cells in the same place.
    #[error(
        "both maps hold the same cells in the same place: copies of one map, not two robots' maps"
    )]
    Copies,
}
