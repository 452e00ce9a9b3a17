//! What a match found.

use nalgebra::Vector2;
use ogm_core::{Outcome, RelativePose, Se2};

use crate::Evidence;

/// Every pose that fits, best first, and whether the best is to be believed.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MatchReport {
    /// Distinct poses, best first, at most five; empty if nothing could be compared.
    pub hypotheses: Vec<Hypothesis>,
    /// The best pose, or why none is believed.
    pub outcome: Outcome<Se2>,
    /// Work done, in the units of [`MatchParams::work_limit`](crate::MatchParams::work_limit).
    pub work: u64,
    /// Whether the work limit left something untried.
    pub exhausted: bool,
}

/// One way to lay the source map on the target map.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Hypothesis {
    /// The pose with its covariance, and the probability that it is right, against every other
    /// pose that was found and against none being right.
    pub pose: RelativePose,
    /// [`Evidence::score`].
    pub score: f64,
    /// Where the walls hold the pose badly, if they do.
    pub weak_direction: Option<WeakDirection>,
    /// Known in both maps over known in the smaller one.
    pub overlap: f64,
    /// Share of the compared wall that fits.
    pub agreement: f64,
    /// The sums behind score, overlap and agreement.
    pub evidence: Evidence,
}

/// A direction along which the maps could slide, as in a corridor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeakDirection {
    /// Unit vector in target axes.
    pub direction: Vector2<f64>,
    /// Standard deviation along it, metres.
    pub sigma_m: f64,
}
