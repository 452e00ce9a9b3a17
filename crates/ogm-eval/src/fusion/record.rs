//! What became of a pair's walls under each rule.

use grid_merge::FusionQuality;
use ogm_merge::FusionRule;

/// Which pose the maps were fused in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pose {
    /// The matcher's, which was right.
    Found,
    /// The true one, where the matcher refused or erred; nothing is known of its uncertainty.
    True,
}

/// A pair, fused by every rule.
#[derive(Debug)]
pub(super) struct Fused {
    pub(super) name: String,
    pub(super) pose: Pose,
    /// Both maps are of one drive: nothing has changed between them.
    pub(super) one_session: bool,
    /// Metres a cell of the merged map.
    pub(super) resolution: f64,
    pub(super) qualities: Vec<(FusionRule, FusionQuality)>,
}

impl Fused {
    pub(super) fn quality(&self, rule: FusionRule) -> Option<&FusionQuality> {
        self.qualities.iter().find(|(of, _)| *of == rule).map(|(_, quality)| quality)
    }
}
