//! The two groups of parallel segments.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use ogm_core::wrap_period;

use crate::params::{GroupRule, Params, SecondGroup};

/// Segments that are parallel to each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Group {
    /// Its segments in the order of the input.
    pub members: Vec<Member>,
    /// Weighted mean of its directions, radians (Tsardoulias et al., Eq. 4); not wrapped. `None`
    /// for an empty group.
    pub direction: Option<f64>,
}

/// A segment in a group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// Position of the segment in the input.
    pub segment: usize,
    /// Its direction, radians, turned by half turns until it lies within 45° of the others; not
    /// wrapped.
    pub direction: f64,
}

/// Angles this close to 45° are 45°, so that rounding does not choose the group, radians.
const TIE: f64 = 1e-12;

/// Groups `directions`, given with their positions, by whether they are parallel to the first
/// (Tsardoulias et al., section 4.1.2, Tables 1 and 2).
pub(crate) fn group(directions: &[(usize, f64)], params: &Params) -> [Group; 2] {
    let mut groups = [Group::default(), Group::default()];
    let Some(&(_, first)) = directions.first() else {
        return groups;
    };
    let [parallel, perpendicular] = &mut groups;
    let mut side = match params.second_group {
        SecondGroup::CounterClockwise => Some(1.0),
        SecondGroup::FirstSegment => None,
    };
    for &(segment, direction) in directions {
        if let Some(direction) = along(first, direction, params.grouping) {
            parallel.members.push(Member { segment, direction });
            continue;
        }
        let side = *side.get_or_insert_with(|| side_of(first, direction, params.grouping));
        let direction = across(first, direction, side, params.grouping);
        perpendicular.members.push(Member { segment, direction });
    }
    groups
}

/// `direction` turned to within 45° of `first`, if it is parallel to it.
fn along(first: f64, direction: f64, rule: GroupRule) -> Option<f64> {
    match rule {
        GroupRule::Wrapped => {
            let difference = wrap_period(direction - first, PI);
            (difference.abs() <= FRAC_PI_4 + TIE).then_some(first + difference)
        }
        GroupRule::AsPrinted => {
            let difference = direction - first;
            if difference >= 3.0 * FRAC_PI_4 - TIE {
                Some(direction - PI)
            } else if difference <= -3.0 * FRAC_PI_4 + TIE {
                Some(direction + PI)
            } else {
                (difference.abs() <= FRAC_PI_4 + TIE).then_some(direction)
            }
        }
    }
}

/// Whether a perpendicular `direction` lies counter-clockwise (1) or clockwise (−1) of `first`.
fn side_of(first: f64, direction: f64, rule: GroupRule) -> f64 {
    let difference = match rule {
        GroupRule::Wrapped => wrap_period(direction - first, TAU),
        GroupRule::AsPrinted => direction - first,
    };
    difference.signum()
}

/// A perpendicular `direction` turned to the `side` of `first`.
fn across(first: f64, direction: f64, side: f64, rule: GroupRule) -> f64 {
    let middle = first + side * FRAC_PI_2;
    match rule {
        GroupRule::Wrapped => middle + wrap_period(direction - middle, PI),
        GroupRule::AsPrinted if side_of(first, direction, rule) == side => direction,
        GroupRule::AsPrinted => direction + side * PI,
    }
}
