//! What each stage of a method by tags saw.

use icp2d::{Alignment, Termination};
use line_ransac::Extraction;
use ogm_core::Se2;
use ogm_vector::OgmVector;
use rfid_loc::{Quadrant, QuadrantConfidence, TagPair, TagRotation};

use crate::Warning;

/// What each stage saw; what a method does not do, or did not reach, is `None` or empty.
#[derive(Debug, Clone, Default)]
pub struct TagEvidence {
    /// Tags localised in both maps, the surest first, whether or not they are sure enough.
    pub common_tags: Vec<TagPair>,
    /// Root mean square distance that the best rigid motion leaves between tags that both maps know
    /// surely, metres, per degree of freedom: it does not grow with their number.
    pub tag_fit_residual: Option<f64>,
    /// The same under the answer, which was not fitted to them.
    pub tag_residual: Option<f64>,
    /// Rotation by the tags alone.
    pub tag_rotation: Option<TagRotation>,
    /// Walls and direction of the target map, then of the source map.
    pub walls: Option<[WallDirection; 2]>,
    /// The quarter turn that tags and walls agree on.
    pub quadrant: Option<Quadrant>,
    /// What tags and walls give, which is the answer of #2.
    pub unrefined_target_from_source: Option<Se2>,
    /// Whether the refinement started from the tags alone, without the direction of the walls.
    pub started_from_tags: bool,
    /// Where the refinement started, after looking around that.
    pub start_target_from_source: Option<Se2>,
    /// The refinement.
    pub refinement: Option<Alignment>,
    /// How far the walls of the two maps agree under the refined transform; of a method that does
    /// not refine, where they agree best around its answer.
    pub wall_agreement: Option<WallAgreement>,
}

/// Walls that one map shows where the other has been.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct WallAgreement {
    /// Wall cells of either map that lie within two cells of a wall of the other.
    pub agreeing: usize,
    /// Wall cells of either map that lie where the other knows.
    pub compared: usize,
}

impl WallAgreement {
    /// Share of the compared cells that agree, or `None` if nothing could be compared.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        (self.compared > 0).then(|| self.agreeing as f64 / self.compared as f64)
    }
}

impl TagEvidence {
    /// What makes the answer less sure than it looks.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        let wall_vectors = || self.walls.iter().flatten().map(|walls| &walls.vector);
        let ended = self.refinement.map(|refinement| refinement.termination);
        [
            (self.tag_rotation.is_some_and(|by_tags| by_tags.mismatch), Warning::TagsMismatch),
            (wall_vectors().any(|vector| vector.weak), Warning::WeakWalls),
            (wall_vectors().any(|vector| vector.single_direction), Warning::SingleWallDirection),
            (
                self.quadrant.is_some_and(|q| q.confidence == QuadrantConfidence::Warning),
                Warning::QuadrantResidual,
            ),
            (self.started_from_tags && self.tag_rotation.is_some(), Warning::StartedFromTags),
            (self.refinement.is_some_and(|r| r.unobservable.is_some()), Warning::Unobservable),
            (ended == Some(Termination::IterationLimit), Warning::NotSettled),
            (matches!(ended, Some(Termination::WorseFit { .. })), Warning::NotImproved),
        ]
        .into_iter()
        .filter_map(|(applies, warning)| applies.then_some(warning))
        .collect()
    }
}

/// The straight walls of one map and the direction they give.
#[derive(Debug, Clone)]
pub struct WallDirection {
    /// Lines after each stage of their extraction.
    pub extraction: Extraction,
    /// Direction of the building in the map frame.
    pub vector: OgmVector,
}
