//! The knobs of every stage, gathered.

use icp2d::{IcpParams, StartParams};
use ogm_core::ClassThresholds;
use rfid_loc::{FilterParams, RotationParams, SelectionParams, TagOnlyParams};

/// Parameters of methods #1, #1b, #2 and #3; each field is that of the crate which does the step.
#[derive(Debug, Clone)]
pub struct RfidParams {
    /// How tags are localised from readings.
    pub filter: FilterParams,
    /// How sure the tags must be.
    pub selection: SelectionParams,
    /// How the tags' rotation is found.
    pub rotation: RotationParams,
    /// Which form of method #1.
    pub tag_only: TagOnlyParams,
    /// How walls are extracted.
    pub lines: line_ransac::Params,
    /// How their direction is found.
    pub vector: ogm_vector::Params,
    /// How far to look around the result of #2 for a better start of the refinement; `None` starts
    /// there, as the paper does, and fails where the surest tag is off by more than the gate.
    pub start: Option<StartParams>,
    /// How the transform is refined.
    pub icp: IcpParams,
    /// What counts as occupied and free.
    pub thresholds: ClassThresholds,
}

impl Default for RfidParams {
    fn default() -> Self {
        Self {
            filter: FilterParams::default(),
            selection: SelectionParams::default(),
            rotation: RotationParams::default(),
            tag_only: TagOnlyParams::default(),
            lines: line_ransac::Params::default(),
            vector: ogm_vector::Params::default(),
            start: Some(StartParams::default()),
            icp: IcpParams::default(),
            thresholds: ClassThresholds::default(),
        }
    }
}

/// Parameters of a merge: how the transform is found and how the cells are fused.
#[derive(Debug, Clone, Default)]
pub struct MergeParams {
    /// How the transform is found.
    pub rfid: RfidParams,
    /// How the cells are fused once it is.
    pub fusion: grid_merge::MergeParams,
}
