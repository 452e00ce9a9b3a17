//! All that two maps say about a pose.

use ogm_core::Se2;

use crate::evidence::{Evidence, Relaxed, WallFit};
use crate::parallel::both;
use crate::prepare::PreparedMap;
use crate::relax::{MovedPatch, relax};
use crate::state::State;
use crate::surroundings::Surroundings;
use crate::wall_counts::{PatchSums, Reach, WallCounts};

/// Most samples of the area for each wall point that may be looked at.
const SAMPLES_A_POINT: usize = 2;

/// The evidence on at most `most` wall points of each map, and where the parts of the second went.
pub(crate) fn evaluate(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> (Evidence, Vec<MovedPatch>) {
    let mut evidence = evaluate_rigid(first, second, first_from_second, reach, most);
    let mut patches = Vec::new();
    if evidence.is_comparable() {
        let second_from_first = first_from_second.inverse();
        let (forth, back) = both(
            || relax(second, first, first_from_second, reach, most),
            || relax(first, second, &second_from_first, reach, most),
        );
        let moved_m = 0.5 * (forth.moved_m + back.moved_m);
        evidence.relaxed = relaxed(&forth.sums, &back.sums, moved_m);
        patches = forth.patches;
    }
    (evidence, patches)
}

/// The evidence of each map as one piece that does not give way.
pub(crate) fn evaluate_rigid(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: &Se2,
    reach: Reach,
    most: usize,
) -> Evidence {
    let forth = PatchSums::rigid(second, first, first_from_second, reach, most);
    let back = PatchSums::rigid(first, second, &first_from_second.inverse(), reach, most);
    let [mut free, mut known, mut near] = [0_u32, 0, 0];
    let stride = second.samples.len().div_ceil(SAMPLES_A_POINT * most).max(1);
    for sample in second.samples.iter().skip(stride / 2).step_by(stride) {
        let Some(cell) = first.lattice.index(*first_from_second * sample.at) else { continue };
        let Surroundings { distance, state, .. } = first.cells[cell];
        let is_known = state != State::Unknown;
        known += u32::from(is_known);
        near += u32::from(is_known && distance.metres() <= reach.hit);
        free += u32::from(state == State::Free && sample.free);
    }
    let sample_area = second.sample_area * stride as f64;
    let smaller = first.known_area().min(second.known_area());
    let mean = |value: fn(&WallCounts) -> f64| 0.5 * (value(&forth.counts) + value(&back.counts));
    Evidence {
        hit_m: mean(|counts| counts.hit),
        near_miss_m: mean(|counts| counts.near_miss),
        conflict_m: mean(|counts| counts.conflict),
        free_m2: f64::from(free) * sample_area,
        overlap: (f64::from(known) * sample_area / smaller).min(1.0),
        same_side_m: mean(|counts| counts.same_side),
        opposite_side_m: mean(|counts| counts.opposite_side),
        chance: f64::from(near) / f64::from(known.max(1)),
        relaxed: relaxed(&forth, &back, 0.0),
    }
}

/// The walls of both maps, whose parts moved by `moved_m`.
fn relaxed(forth: &PatchSums, back: &PatchSums, moved_m: f64) -> Relaxed {
    Relaxed {
        walls: worse_first(forth.counts.fit(), back.counts.fit()),
        corners: 0.5 * (forth.corners + back.corners),
        moved_m,
    }
}

fn worse_first(one: WallFit, other: WallFit) -> [WallFit; 2] {
    if one.misfit() >= other.misfit() { [one, other] } else { [other, one] }
}
