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

/// A whole turn in steps of 3°.
pub(crate) fn sweep() -> Vec<f64> {
    (0..120).map(|step| wrap_angle(f64::from(step) * TAU / 120.0)).collect()
}

/// Rotations to both sides of each of `rotations`, out to `reach` by at most `step`, without these
/// themselves.
pub(crate) fn fan(rotations: &[f64], reach: f64, step: f64) -> Vec<f64> {
    let steps = (reach / step).ceil().max(1.0);
    let mut around = Vec::new();
    for &theta in rotations {
        let mut index = 1.0;
        while index <= steps {
            let offset = reach * index / steps;
            around.extend([wrap_angle(theta - offset), wrap_angle(theta + offset)]);
            index += 1.0;
        }
    }
    around
}
