//! Rotations worth trying.

use std::f64::consts::{PI, TAU};

use ogm_core::wrap_angle;

use crate::spectrum::{ANGLES, Spectrum, circular_correlation};

/// Angles between two peaks of the correlation: 3°.
const APART: usize = 12;
/// Correlation below which spectra have nothing in common.
const LEAST_CORRELATION: f64 = 0.1;
/// Step of a sweep, radians.
pub(crate) const SWEEP_STEP: f64 = 3.0 * PI / 180.0;

/// The best rotations of `first_from_second`, both halves of the turn for each of at most `most`
/// peaks of the correlation of the spectra; strongest first.
pub(crate) fn by_spectrum(first: &Spectrum, second: &Spectrum, most: usize) -> Vec<f64> {
    let correlation = circular_correlation(first, second);
    let at = |index: usize| correlation[index % ANGLES];
    let mut peaks: Vec<usize> = (0..ANGLES)
        .filter(|&index| {
            let value = at(index);
            value > LEAST_CORRELATION && value > at(index + ANGLES - 1) && value >= at(index + 1)
        })
        .collect();
    peaks.sort_by(|&a, &b| correlation[b].total_cmp(&correlation[a]));
    let mut kept: Vec<usize> = Vec::new();
    for peak in peaks {
        let distance = |other: usize| peak.abs_diff(other).min(ANGLES - peak.abs_diff(other));
        if kept.len() < most && kept.iter().all(|&other| distance(other) > APART) {
            kept.push(peak);
        }
    }
    let refined = kept.into_iter().map(|peak| {
        let [before, here, after] = [at(peak + ANGLES - 1), at(peak), at(peak + 1)];
        let bend = before - 2.0 * here + after;
        let offset = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        (peak as f64 + offset) * PI / ANGLES as f64
    });
    refined.flat_map(|theta| [wrap_angle(theta), wrap_angle(theta + PI)]).collect()
}

/// A rotation, and which are wanted of it and of the half turn more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurnPair {
    pub(crate) theta: f64,
    pub(crate) wanted: [bool; 2],
}

/// The same rotations, those that half a turn parts together.
pub(crate) fn by_half_turns(rotations: &[f64]) -> Vec<TurnPair> {
    let mut turns: Vec<TurnPair> = Vec::new();
    for &theta in rotations {
        let opposite = |turn: &&mut TurnPair| wrap_angle(turn.theta + PI - theta).abs() < 1e-9;
        match turns.iter_mut().find(opposite) {
            Some(turn) => turn.wanted[1] = true,
            None => turns.push(TurnPair { theta, wanted: [true, false] }),
        }
    }
    turns
}

/// A whole turn in steps of 3°.
pub(crate) fn sweep() -> Vec<f64> {
    (0..120).map(|step| wrap_angle(f64::from(step) * TAU / 120.0)).collect()
}

/// Rotations by `apart` to both sides of each of `rotations`, without these themselves.
pub(crate) fn beside(rotations: &[f64], apart: f64) -> Vec<f64> {
    rotations.iter().flat_map(|theta| [theta - apart, theta + apart]).map(wrap_angle).collect()
}

#[cfg(test)]
mod tests {
    use super::{by_half_turns, sweep};
    use ogm_core::wrap_angle;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use std::f64::consts::PI;

    proptest! {
        #[test]
        fn half_turns_share_and_no_rotation_is_lost(
            rotations in proptest::collection::vec(-PI..PI, 0..6),
        ) {
            let halves = rotations.iter().map(|theta| wrap_angle(theta + PI));
            let all: Vec<f64> = rotations.iter().copied().chain(halves).collect();
            let turns = by_half_turns(&all);
            prop_assert_eq!(turns.len(), rotations.len());
            for (turn, theta) in turns.iter().zip(&rotations) {
                prop_assert_eq!((turn.theta, turn.wanted), (*theta, [true, true]));
            }
            let alone = by_half_turns(&rotations);
            prop_assert!(alone.iter().all(|turn| turn.wanted == [true, false]));
        }
    }

    #[test]
    fn a_whole_turn_takes_half_its_transforms() {
        assert_eq!(by_half_turns(&sweep()).len(), 60);
    }
}
