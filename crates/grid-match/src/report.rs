//! What a match found.

use nalgebra::{Point2, Vector2};
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
    /// How the maps are bent against each other.
    pub bend: Bend,
}

impl Hypothesis {
    /// The same way to lay the target map on the source map.
    pub(crate) fn inverse(self) -> Self {
        let pose = self.pose.inverse();
        let source_from_target = pose.target_from_source;
        let weak_direction = self.weak_direction.map(|weak| WeakDirection {
            direction: source_from_target * weak.direction,
            sigma_m: weak.sigma_m,
        });
        let bend = self.bend.inverse(&self.pose.target_from_source);
        Self { pose, weak_direction, bend, ..self }
    }
}

/// A direction along which the maps could slide, as in a corridor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeakDirection {
    /// Unit vector in target axes.
    pub direction: Vector2<f64>,
    /// Standard deviation along it, metres.
    pub sigma_m: f64,
}

/// How far parts of the source map, about the size of a room, lie from where its pose as one piece
/// puts them: what drift did to either map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bend {
    /// Root mean square of the shifts, weighed by the wall that fits, metres.
    pub rms_m: f64,
    /// Change of length of the source along x and y of its own map that the shifts show, over its
    /// length: 0.05 where the target is 5 % longer; zero where too few parts fit to say.
    pub stretch: Vector2<f64>,
    /// Parts of which at least half the wall fits.
    pub patches: Vec<PatchMotion>,
}

/// Where a part of the source map lies on the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchMotion {
    /// The middle of its walls, in the source map, metres.
    pub at: Point2<f64>,
    /// How far it lies from where the pose puts it, in target axes, metres.
    pub shift: Vector2<f64>,
    /// And how far it is turned, radians.
    pub turn: f64,
    /// Metres of its wall that fit.
    pub hit_m: f64,
}
