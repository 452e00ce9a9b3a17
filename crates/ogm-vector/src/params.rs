//! Knobs of the estimate.

/// Knobs of [`ogm_vector`](crate::ogm_vector).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// What a segment counts (Tsardoulias et al., Eq. 4, corrected).
    pub weights: Weights,
    /// How the direction follows from the segments.
    pub estimator: Estimator,
    /// Which segments are parallel to the first.
    pub grouping: GroupRule,
    /// On which side of the first group the directions of the second are written.
    pub second_group: SecondGroup,
    /// Strength, in [0, 1], below which the building is not rectangular enough to trust the
    /// direction: 0.5, half of what parallel and perpendicular walls alone give.
    pub weak_below: f64,
}

/// What a segment counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Weights {
    /// Length times reliability.
    LengthTimesReliability,
    /// Length times (1 − reliability), as in Eq. 4: it prefers the worst segments, and nothing is
    /// left of perfect ones.
    AsPrinted,
}

/// How the direction follows from the segments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Estimator {
    /// Weighted mean modulo a quarter turn. Every segment counts by its weight, and the order of
    /// the segments does not matter.
    FourFold,
    /// Bisector of the mean directions of the two groups, as the paper has it; both groups count
    /// the same, whatever their segments weigh.
    Bisector,
}

/// Which segments are parallel to the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum GroupRule {
    /// Those within 45° of it modulo half a turn.
    Wrapped,
    /// The printed inequalities, which do not wrap and so put perpendicular walls into one group
    /// when the first direction is beyond ±45°.
    AsPrinted,
}

/// On which side of the first group the directions of the second are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SecondGroup {
    /// Counter-clockwise of it.
    CounterClockwise,
    /// Where the first of its segments lies, as the paper has it.
    FirstSegment,
}

impl Params {
    /// The structure that Tsardoulias et al. print, with corrected weights and grouping.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            estimator: Estimator::Bisector,
            second_group: SecondGroup::FirstSegment,
            ..Self::default()
        }
    }
}

impl Default for Params {
    fn default() -> Self {
        Self {
            weights: Weights::LengthTimesReliability,
            estimator: Estimator::FourFold,
            grouping: GroupRule::Wrapped,
            second_group: SecondGroup::CounterClockwise,
            weak_below: 0.5,
        }
    }
}
