//! The wall direction of a map and the rotation between two maps.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use ogm_core::{Outcome, Refusal, Segment, mean_k_fold, wrap_period};

use crate::group::{Group, group};
use crate::params::{Estimator, Params, Weights};

/// The direction of the walls of a rectangular building.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OgmVector {
    /// Direction of the walls modulo a quarter turn, in [−π/4, π/4), radians.
    pub direction: f64,
    /// How rectangular the building is: 1 if all walls are parallel or perpendicular, 0 if their
    /// directions cancel.
    pub strength: f64,
    /// Segments parallel to the first, and the others.
    pub groups: [Group; 2],
    /// Whether one group is empty, so that one direction alone speaks.
    pub single_direction: bool,
    /// Whether the strength is below [`Params::weak_below`].
    pub weak: bool,
    /// Whether the weights of a group summed to zero, so that length alone counted.
    pub weights_fell_back: bool,
}

impl OgmVector {
    /// The paper's angle, the bisector of two perpendicular walls: `direction` − π/4, in
    /// [−π/2, 0), radians.
    #[must_use]
    pub fn theta_ogm(&self) -> f64 {
        self.direction - FRAC_PI_4
    }

    /// Mean directions of the two groups, radians, not wrapped.
    #[must_use]
    pub fn group_directions(&self) -> [Option<f64>; 2] {
        [self.groups[0].direction, self.groups[1].direction]
    }
}

/// The direction of the walls that `segments` are pieces of (Tsardoulias et al., section 4.1.2).
///
/// Segments without a length, or with a number that is not finite, take no part. Refused when none
/// is left, and when their directions cancel so that there is no mean.
pub fn ogm_vector(segments: &[Segment], params: &Params) -> Outcome<OgmVector> {
    estimate(segments, params).ok_or(Refusal::NoLines { candidates: segments.len() }).into()
}

/// The rotation that turns the walls of `source` onto those of `target`, modulo a quarter turn: in
/// [−π/4, π/4), radians.
#[must_use]
pub fn wall_rotation(target: &OgmVector, source: &OgmVector) -> f64 {
    wrap_period(target.direction - source.direction, FRAC_PI_2)
}

/// Whether a segment says anything about a direction.
pub(crate) fn is_usable(segment: &Segment) -> bool {
    let length = segment.length();
    length > 0.0
        && length.is_finite()
        && segment.direction.is_finite()
        && segment.reliability.is_finite()
}

fn estimate(segments: &[Segment], params: &Params) -> Option<OgmVector> {
    let usable = segments.iter().enumerate().filter(|(_, s)| is_usable(s));
    let directions: Vec<_> = usable.map(|(index, s)| (index, s.direction)).collect();
    let mut groups = group(&directions, params);

    let weight_of = |segment: usize| weight(&segments[segment], params.weights);
    let weights_fell_back = groups.iter().any(|group| {
        let total: f64 = group.members.iter().map(|m| weight_of(m.segment)).sum();
        !group.members.is_empty() && total <= 0.0
    });
    let weight_of = |segment: usize| {
        if weights_fell_back { segments[segment].length() } else { weight_of(segment) }
    };
    for group in &mut groups {
        let weighted = group.members.iter().map(|m| (m.direction, weight_of(m.segment)));
        group.direction = weighted_mean(weighted);
    }

    let weighted = directions.iter().map(|&(segment, d)| (d, weight_of(segment)));
    let four_fold = mean_k_fold(weighted, 4);
    let direction = match params.estimator {
        Estimator::FourFold => four_fold?.direction,
        Estimator::Bisector => bisector(&groups)?,
    };
    let strength = four_fold.map_or(0.0, |mean| mean.strength);
    Some(OgmVector {
        direction,
        strength,
        single_direction: groups.iter().any(|group| group.members.is_empty()),
        weak: strength < params.weak_below,
        weights_fell_back,
        groups,
    })
}

fn weight(segment: &Segment, rule: Weights) -> f64 {
    let share = match rule {
        Weights::LengthTimesReliability => segment.reliability,
        Weights::AsPrinted => 1.0 - segment.reliability,
    };
    segment.length() * share
}

/// Tsardoulias et al., Eq. 4. The directions of a group lie within 45° of one, so a plain mean is
/// a mean of angles.
fn weighted_mean(weighted: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (mut sum, mut total) = (0.0, 0.0);
    for (direction, weight) in weighted {
        sum += direction * weight;
        total += weight;
    }
    Some(sum / total).filter(|mean| mean.is_finite())
}

/// Wall direction from the bisector of the groups; an empty one is perpendicular to the other.
fn bisector(groups: &[Group; 2]) -> Option<f64> {
    let [parallel, perpendicular] = groups.each_ref().map(|group| group.direction);
    let bisector = match (parallel, perpendicular) {
        (Some(first), Some(second)) => f64::midpoint(first, second),
        (Some(only), None) | (None, Some(only)) => only + FRAC_PI_4,
        (None, None) => return None,
    };
    Some(wrap_period(bisector - FRAC_PI_4, FRAC_PI_2))
}
