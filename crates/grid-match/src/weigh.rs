//! All that two maps say about a pose.

use nalgebra::Rotation2;
use ogm_core::Se2;

use crate::evidence::{Evidence, Relaxed};
use crate::patches::relaxed_tally;
use crate::prepare::{PreparedMap, State};
use crate::tally::{Reach, Tally};

/// The evidence on at most `most` wall points of each map.
pub(crate) fn weigh(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> Evidence {
    let mut evidence = weigh_as_one(first, second, first_from_second, reach, most);
    if evidence.is_comparable() {
        let second_from_first = first_from_second.inverse();
        let (forth, one) = relaxed_tally(second, first, first_from_second, reach, most);
        let (back, other) = relaxed_tally(first, second, &second_from_first, reach, most);
        evidence.relaxed = Relaxed {
            hit_m: 0.5 * (forth.hit + back.hit),
            near_miss_m: 0.5 * (forth.near_miss + back.near_miss),
            conflict_m: 0.5 * (forth.conflict + back.conflict),
            moved_m: 0.5 * (one + other),
        };
    }
    evidence
}

/// The evidence of each map as one piece, without what it would be if it gave way.
pub(crate) fn weigh_as_one(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> Evidence {
    let forth = Tally::of(second, first, first_from_second, reach, most);
    let back = Tally::of(first, second, &first_from_second.inverse(), reach, most);
    let [mut free, mut known, mut near] = [0_u32, 0, 0];
    for sample in &second.samples {
        let Some(cell) = first.lattice.index(*first_from_second * sample.at) else { continue };
        let is_known = first.state[cell] != State::Unknown;
        known += u32::from(is_known);
        near += u32::from(is_known && f64::from(first.distance[cell]) <= reach.hit);
        free += u32::from(first.state[cell] == State::Free && sample.free);
    }
    let smaller = first.known_area().min(second.known_area());
    // The normals of the second tally are in the frame of the second map.
    let turn = Rotation2::new(first_from_second.theta()).into_inner();
    let spread = (forth.spread + turn * back.spread * turn.transpose()) * 0.5;
    let mean = |value: fn(&Tally) -> f64| 0.5 * (value(&forth) + value(&back));
    Evidence {
        hit_m: mean(|tally| tally.hit),
        near_miss_m: mean(|tally| tally.near_miss),
        conflict_m: mean(|tally| tally.conflict),
        free_m2: f64::from(free) * second.sample_area,
        overlap: (f64::from(known) * second.sample_area / smaller).min(1.0),
        same_side_m: mean(|tally| tally.same_side),
        opposite_side_m: mean(|tally| tally.opposite_side),
        cross_m: spread.symmetric_eigenvalues().min().max(0.0),
        chance: f64::from(near) / f64::from(known.max(1)),
        relaxed: Relaxed::default(),
    }
}
