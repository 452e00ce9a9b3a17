//! A pose that came to rest beside its place goes there, led by a part of the map that let go.

use nalgebra::Vector2;
use ogm_core::Se2;

use crate::evaluate::evaluate_rigid;
use crate::prepare::PreparedMap;
use crate::refine::polish;
use crate::search::{FINE_POINTS, Fit, evaluate_in_full};
use crate::wall_counts::Reach;

/// Shifts closer than this are one, metres: about the reach of a hit.
const APART_M: f64 = 0.1;

/// `fit`, or the pose beside it that shows more of the same walls.
///
/// A refinement weighs only what is near, so it can come to rest a wall's thickness or a few
/// decimetres off, along walls that go on; and the score does not show it, for there parts may give
/// way. Where all of the map, as one piece, fits better with the shift of one part, that is the pose,
/// unless its score is lower.
pub(crate) fn settled(
    first: &PreparedMap,
    second: &PreparedMap,
    fit: Fit,
    is_allowed: impl Fn(&Se2) -> bool,
) -> Fit {
    let reach = Reach::at(first.resolution().max(second.resolution()));
    let as_one_piece = |first_from_second: &Se2| {
        evaluate_rigid(first, second, first_from_second, reach, FINE_POINTS).rough_score()
    };
    let own = as_one_piece(&fit.first_from_second);
    let shifted = shifts(&fit).into_iter().map(|shift| {
        let first_from_second = Se2::new(shift.x, shift.y, 0.0) * fit.first_from_second;
        (as_one_piece(&first_from_second), first_from_second)
    });
    let better = shifted.filter(|(score, _)| *score > own);
    let Some((_, start_first_from_second)) = better.reduce(|a, b| if b.0 > a.0 { b } else { a })
    else {
        return fit;
    };
    let first_from_second = polish(first, second, start_first_from_second);
    if !is_allowed(&first_from_second) || as_one_piece(&first_from_second) <= own {
        return fit;
    }
    let moved = evaluate_in_full(first, second, first_from_second);
    if moved.score >= fit.score { moved } else { fit }
}

/// How far parts of the second map went on the first, each once.
fn shifts(fit: &Fit) -> Vec<Vector2<f64>> {
    let mut shifts = vec![Vector2::zeros()];
    for patch in &fit.patches {
        let shift = patch.on_from_map * patch.centre - fit.first_from_second * patch.centre;
        if shifts.iter().all(|other| (other - shift).norm() > APART_M) {
            shifts.push(shift);
        }
    }
    shifts.split_off(1)
}
