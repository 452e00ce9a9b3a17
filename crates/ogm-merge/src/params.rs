//! The knobs of every stage, gathered.

use carpin_walk::Objective;
use grid_match::{MatchParams, Prior};
use icp2d::{IcpParams, StartParams};
use ogm_core::ClassThresholds;
use radon_merge::RadonParams;
use rfid_loc::{RotationParams, SelectionParams, TagOnlyParams};

/// How [`align_pair`](crate::align_pair) looks for a transform; each field is that of the crate
/// which does the step.
#[derive(Debug, Clone)]
pub struct AlignParams {
    /// Seed of everything random; it replaces that of every stage.
    pub seed: u64,
    /// A pose that is already believed, for the methods that take one
    /// ([`Method::takes_prior`](crate::Method::takes_prior)); `None` looks everywhere. It replaces
    /// that of `matching`.
    pub prior: Option<Prior>,
    /// The methods by tags.
    pub rfid: RfidParams,
    /// The maps alone, and what an answer must reach.
    pub matching: MatchParams,
    /// Segments and the Radon transform.
    pub radon: RadonParams,
    /// What the random walk makes least: the distance of the walls where both maps know, as long
    /// as they overlap by a quarter. The paper's picture distance draws maps together that overlap
    /// in part.
    pub walk_objective: Objective,
}

impl Default for AlignParams {
    fn default() -> Self {
        Self {
            seed: 0,
            prior: None,
            rfid: RfidParams::default(),
            matching: MatchParams::default(),
            radon: RadonParams::default(),
            walk_objective: Objective::Overlap { min_share: 0.25 },
        }
    }
}

/// Parameters of methods #1, #1b, #2 and #3; each field is that of the crate which does the step.
#[derive(Debug, Clone)]
pub struct RfidParams {
    /// How sure the tags must be.
    pub selection: SelectionParams,
    /// How the tags' rotation is found in #1b, #2 and #3; #1 has its own in `tag_only`.
    pub rotation: RotationParams,
    /// Which form of method #1.
    pub tag_only: TagOnlyParams,
    /// Which tags carry the translation of #2.
    pub anchor: Anchor,
    /// How walls are extracted; its classes are replaced by `thresholds`.
    pub lines: line_ransac::Params,
    /// How their direction is found.
    pub vector: ogm_vector::Params,
    /// How far to look around the result of #2 for a better start of the refinement; `None` starts
    /// there, as the paper does, and fails where the surest tag is off by more than the gate.
    pub start: Option<StartParams>,
    /// How the transform is refined.
    pub icp: IcpParams,
    /// How far tags that both maps know surely may stay apart, root mean square, metres; nearer
    /// where they fit well (see [`TagEvidence::tag_residual`](crate::TagEvidence::tag_residual)):
    /// 0.7. `f64::INFINITY` asks for nothing.
    pub max_tag_residual: f64,
    /// Least share of the common walls that must agree under the answer, or around one that is not
    /// refined: 0.45. Maps of different buildings reached 0.35 where they fit best; drifted maps of
    /// one went down to 0.53. 0 asks for nothing.
    pub min_wall_agreement: f64,
    /// What counts as occupied and free in every stage before the fusion.
    pub thresholds: ClassThresholds,
}

/// Which tags carry the translation of #2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Anchor {
    /// The surest (Eqs. 8, 9).
    #[default]
    BestTag,
    /// The centroid of the three.
    AllTags,
}

impl RfidParams {
    /// As printed: each step's `paper` form, the three surest tags wherever they lie, ICP from where
    /// #2 ends, and no answer refused for what tags or walls say about it.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            selection: SelectionParams { min_separation: 0.0, ..SelectionParams::default() },
            tag_only: TagOnlyParams::paper(),
            lines: line_ransac::Params::paper(),
            vector: ogm_vector::Params::paper(),
            start: None,
            icp: IcpParams::paper(),
            ..Self::unguarded()
        }
    }

    /// The defaults, and no answer refused for what tags or walls say about it.
    #[must_use]
    pub fn unguarded() -> Self {
        Self { max_tag_residual: f64::INFINITY, min_wall_agreement: 0.0, ..Self::default() }
    }
}

impl Default for RfidParams {
    fn default() -> Self {
        Self {
            selection: SelectionParams::default(),
            rotation: RotationParams::default(),
            tag_only: TagOnlyParams::default(),
            anchor: Anchor::default(),
            lines: line_ransac::Params::default(),
            vector: ogm_vector::Params::default(),
            start: Some(StartParams::default()),
            icp: IcpParams::default(),
            max_tag_residual: 0.75,
            min_wall_agreement: 0.45,
            thresholds: ClassThresholds::default(),
        }
    }
}
