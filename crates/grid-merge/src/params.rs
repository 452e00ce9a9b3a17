//! What can be chosen about a merge.

use ogm_core::ClassThresholds;

/// What can be chosen about a merge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FusionParams {
    /// How cells get from a map onto the output; inverse by default, because it leaves no gaps.
    pub mapping: Mapping,
    /// What a cell becomes that several maps know; walls are kept by default, because a planner may
    /// drive through a wall that two maps of half a cell's difference have cancelled.
    pub fusion: FusionRule,
    /// Metres a cell of the output; `None` is the resolution of the first map. A finer map is
    /// [coarsened](crate::coarsen()) before it is mapped.
    pub resolution: Option<f64>,
    /// Where occupied begins and free ends, for conflicts, hole filling and coarsening; 0.65 and
    /// 0.35, symmetric in log-odds.
    pub thresholds: ClassThresholds,
}

impl FusionParams {
    /// The structure of Tsardoulias et al., section 4.4, with its errors corrected: forward
    /// mapping of cell centres, gaps filled from their free neighbours, and log-odds summed (the
    /// paper names no rule).
    #[must_use]
    pub fn paper() -> Self {
        Self {
            mapping: Mapping::Forward {
                rounding: ForwardRounding::default(),
                gaps: GapTreatment::default(),
            },
            fusion: FusionRule::LogOdds,
            ..Self::default()
        }
    }
}

/// How cells get from a map onto the output.
///
/// A map that lies on the output's lattice is copied, whatever the mapping.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mapping {
    /// Every output cell looks up its centre in the map: no gaps.
    Inverse(Interpolation),
    /// Every known map cell is written where it lands, the later one of two (in rows upwards)
    /// stays; rotation leaves a share of (|cos θ| + |sin θ| − 1)² of the cells unwritten.
    Forward {
        /// Where a cell lands.
        rounding: ForwardRounding,
        /// What happens to the cells that nothing lands on.
        gaps: GapTreatment,
    },
}

impl Default for Mapping {
    fn default() -> Self {
        Self::Inverse(Interpolation::default())
    }
}

/// What an output cell reads in a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// The cell that contains the point.
    #[default]
    Nearest,
    /// Log-odds between the four nearest cell centres where all four are known, else the cell that
    /// contains the point.
    Bilinear,
}

/// Where forward mapping writes a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ForwardRounding {
    /// The cell that contains the image of its centre: unbiased.
    #[default]
    Centre,
    /// The cell that contains the image of its lower-left corner, which is Tsardoulias et al.,
    /// Eq. 15: biased by half a cell along both axes of the output.
    FloorOfInteger,
}

/// What happens to the gaps of forward mapping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GapTreatment {
    /// They stay unknown.
    None,
    /// An unknown cell with at least five known neighbours of eight, in the map as it was mapped
    /// and before fusion, becomes the mean of its free neighbours if most known ones are free,
    /// else the mean of all known ones.
    #[default]
    HoleFill,
    /// 3 × 3 mean of the fused map (Eq. 16), unknown counting as one half, once a merge. Diffuses:
    /// walls fade as merges follow each other.
    BlurEverywhere,
    /// The mean of Eq. 16 on explored, unoccupied cells only, as printed after Eq. 16: it leaves
    /// every gap open and puts wall mass on the free cells beside a wall.
    PrintedCondition,
}

/// What a cell becomes that several maps know. Unknown is neutral in all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum FusionRule {
    /// No wall is lost: a wall beside another map's is the same wall where the poses leave that
    /// open, and stays once, where the surer map has it; any other wall stays, whoever says free,
    /// as a conflict. Free evidence is summed as log-odds.
    #[default]
    KeepWalls,
    /// The log-odds are summed and clamped; any order of the maps gives the same bytes.
    LogOdds,
    /// The value furthest from one half, which itself is the answer to a tie of wall and free; any
    /// order of the maps gives the same bytes.
    MaxConfidence,
    /// The most occupied value.
    Occupied,
    /// The first map that knows the cell.
    First,
    /// The last map that knows the cell.
    Last,
}
