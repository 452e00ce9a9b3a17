//! The knobs of a match.

use ogm_core::{ClassThresholds, Se2};

/// How a match is searched for and when it is believed.
#[derive(Debug, Clone)]
pub struct MatchParams {
    /// Least probability of an accepted match; 0.90, at which wrong merges stay rare on simulated
    /// and real pairs.
    pub accept: f64,
    /// A pose that is already believed; `None` searches everywhere.
    pub prior: Option<Prior>,
    /// Whether the building is known to repeat itself: equal rooms, or halves that mirror each
    /// other. Then a good fit alone is no proof, and only what is beyond doubt is believed.
    pub repeats: bool,
    /// What counts as occupied and free.
    pub thresholds: ClassThresholds,
    /// Least metres of wall in each map; 3 m, less than the walls of the smallest room.
    pub min_wall_m: f64,
    /// How hard to look before giving up.
    pub effort: Effort,
    /// Most work before the search stops with what it has, in units of about a microsecond of one
    /// core; counted and not timed, so the answer is the same everywhere. `None` is no limit.
    pub work_limit: Option<u64>,
}

impl Default for MatchParams {
    fn default() -> Self {
        Self {
            accept: 0.90,
            prior: None,
            repeats: false,
            thresholds: ClassThresholds::default(),
            min_wall_m: 3.0,
            effort: Effort::Standard,
            work_limit: None,
        }
    }
}

/// How hard to look before giving up; each tier is entered only if the one before it found nothing
/// to accept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effort {
    /// The rotations that the walls' directions suggest.
    Fast,
    /// Then a little to both sides of the strongest of these.
    Standard,
    /// Then a whole turn in steps of 3°: helps maps whose walls have no direction.
    Thorough,
}

/// A believed pose and how far to believe it: the search is bounded at three standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// The pose.
    pub target_from_source: Se2,
    /// Standard deviation of its translation, metres.
    pub sigma_m: f64,
    /// Standard deviation of its rotation, radians.
    pub sigma_rad: f64,
}
