//! What each stage of a merge saw and decided.

use icp2d::Alignment;
use line_ransac::Extraction;
use ogm_core::{Outcome, Se2};
use ogm_vector::OgmVector;
use rfid_loc::{Quadrant, TagPair, TagRotation};

use crate::Method;

/// The answer of a recipe, and what led to it.
#[derive(Debug, Clone)]
pub struct MergeReport {
    /// Which recipe.
    pub method: Method,
    /// Metres a cell of the maps as they were aligned: the coarser of the two.
    pub resolution: f64,
    /// What the stages saw, as far as they were reached.
    pub evidence: Evidence,
    /// The transform that maps points of the source map into the target map, or why there is none.
    pub outcome: Outcome<Se2>,
}

/// What each stage saw; what a method does not do, or did not reach, is `None` or empty.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    /// Tags localised in both maps, the surest first, whether or not they are sure enough.
    pub common_tags: Vec<TagPair>,
    /// Rotation by the tags alone.
    pub tag_rotation: Option<TagRotation>,
    /// Walls and direction of the target map, then of the source map.
    pub walls: Option<[WallDirection; 2]>,
    /// The quarter turn that tags and walls agree on.
    pub quadrant: Option<Quadrant>,
    /// The transform before refinement.
    pub start_target_from_source: Option<Se2>,
    /// The refinement.
    pub refinement: Option<Alignment>,
}

/// The straight walls of one map and the direction they give.
#[derive(Debug, Clone)]
pub struct WallDirection {
    /// Lines after each stage of their extraction.
    pub extraction: Extraction,
    /// Direction of the building in the map frame.
    pub vector: OgmVector,
}
