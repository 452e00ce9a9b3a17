//! The knobs of every block, gathered.

use ogm_core::{ClassThresholds, ParameterError};

use crate::{
    DistinctiveParams, EdgeParams, HypothesisParams, RotationParams, SegmentParams,
    TranslationParams, VerificationParams,
};

/// Parameters of [`find_transform`](crate::find_transform); each field is that of its block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadonParams {
    /// Decides which segments are drawn where there are more than are compared.
    pub seed: u64,
    /// What counts as occupied and free.
    pub thresholds: ClassThresholds,
    /// How edges are detected.
    pub edges: EdgeParams,
    /// Edges nearer than this become one, cells: d_t of the paper, which prints none. 7 cells take
    /// both faces of a wall of 0.12 m in cells of 0.05 m.
    pub max_gap: usize,
    /// How segments are traced.
    pub segments: SegmentParams,
    /// Which segments are worth comparing.
    pub distinctive: DistinctiveParams,
    /// How poses are proposed.
    pub hypotheses: HypothesisParams,
    /// How the rotation is tuned.
    pub rotation: RotationParams,
    /// How the translation is tuned.
    pub translation: TranslationParams,
    /// What an accepted transform must show.
    pub verification: VerificationParams,
}

impl Default for RadonParams {
    fn default() -> Self {
        Self {
            seed: 0,
            thresholds: ClassThresholds::default(),
            edges: EdgeParams::default(),
            max_gap: 7,
            segments: SegmentParams::default(),
            distinctive: DistinctiveParams::default(),
            hypotheses: HypothesisParams::default(),
            rotation: RotationParams::default(),
            translation: TranslationParams::default(),
            verification: VerificationParams::default(),
        }
    }
}

impl RadonParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        self.edges.check()?;
        self.segments.check()?;
        self.distinctive.check()?;
        self.hypotheses.check()?;
        self.rotation.check()?;
        self.translation.check()?;
        self.verification.check()
    }
}
