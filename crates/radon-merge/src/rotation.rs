//! The rotation, tuned by the Radon images of both maps.

use ogm_core::{ParameterError, require, wrap_angle, wrap_period};
use std::f64::consts::PI;

use crate::RadonError;
use crate::RadonImage;

/// How the rotation is tuned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationParams {
    /// Radians between two Radon angles; 0.25°, where the paper prints no step.
    pub angle_step: f64,
    /// Largest correction, radians: 12°. Perpendicular walls give a second peak a right angle
    /// away, and a segment's line is good to a few degrees.
    pub window: f64,
}

impl Default for RotationParams {
    fn default() -> Self {
        Self { angle_step: 0.25_f64.to_radians(), window: 12.0_f64.to_radians() }
    }
}

impl RotationParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let step_ok = self.angle_step >= 1e-4 && self.angle_step <= 0.2;
        require(step_ok, "rotation.angle_step", "0.0001 to 0.2 rad", self.angle_step)?;
        let window_ok = self.window >= 0.0 && self.window <= PI / 2.0;
        require(window_ok, "rotation.window", "0 to a quarter turn", self.window)
    }
}

/// The correction that brings the peak of the source, at `source_peak`, onto that of the target:
/// their difference modulo half a turn, in [−π/2, π/2) (Saeedi et al., Eq. 15).
fn peak_correction(target_peak: f64, source_peak: f64) -> f64 {
    wrap_period(target_peak - source_peak, PI)
}

/// The correction to `rotation`, the approximate one from source to target, that brings the
/// highest peak of the source within ±`window` of the target's highest onto it (Saeedi et al.,
/// Eqs. 14 and 15, with the arg max that the text describes). As fine as the images' angles.
///
/// # Errors
/// Images of different angles, a window out of range, or a rotation that is not finite.
pub fn tune_by_peaks(
    target: &RadonImage,
    source: &RadonImage,
    rotation: f64,
    window: f64,
) -> Result<f64, RadonError> {
    check(target, source, rotation)?;
    RotationParams { window, ..RotationParams::default() }.check()?;
    let step = target.angle_step;
    let target_peak = highest(&target.peaks(), |_| true).map_or(0.0, |i| i as f64 * step);
    let turned = |index: usize| index as f64 * step + rotation;
    let near = |index| peak_correction(target_peak, turned(index)).abs() <= window;
    let source_peak = highest(&source.peaks(), near);
    Ok(source_peak.map_or(0.0, |index| peak_correction(target_peak, turned(index))))
}

/// How well the walls of two maps run alike under every rotation.
///
/// The energy of a Radon image moves cyclically as its map turns. So one correlation of the two
/// energies tunes any number of approximate rotations.
#[derive(Debug, Clone, PartialEq)]
pub struct RotationCorrelation {
    /// Sum over all angles of the product of both energies, in the order of the rotation of the
    /// source: 0, one step, … up to half a turn.
    pub values: Vec<f64>,
    /// Radians between two values.
    pub angle_step: f64,
}

impl RotationCorrelation {
    /// Correlates the energies of two images.
    ///
    /// # Errors
    /// Images of different angles.
    pub fn between(target: &RadonImage, source: &RadonImage) -> Result<Self, RadonError> {
        check(target, source, 0.0)?;
        let (target_energy, source_energy) = (target.energy(), source.energy());
        let count = target_energy.len();
        let values = (0..count).map(|shift| {
            let (before, after) = source_energy.split_at(count - shift);
            let shifted = after.iter().chain(before);
            target_energy.iter().zip(shifted).map(|(a, b)| a * b).sum()
        });
        Ok(Self { values: values.collect(), angle_step: target.angle_step })
    }

    /// The correction to `rotation`, at most `window` either way, under which walls run most
    /// alike; between the steps by a parabola.
    #[must_use]
    pub fn correction(&self, rotation: f64, window: f64) -> f64 {
        let offset = |index: usize| wrap_period(index as f64 * self.angle_step - rotation, PI);
        let Some(best) = highest(&self.values, |index| offset(index).abs() <= window) else {
            return 0.0;
        };
        let count = self.values.len();
        let (before, peak, after) = (
            self.values[(best + count - 1) % count],
            self.values[best],
            self.values[(best + 1) % count],
        );
        let curvature = before - 2.0 * peak + after;
        // At the end of the window the neighbour outside may be higher.
        let within = if curvature < 0.0 && peak >= before && peak >= after {
            0.5 * (before - after) / curvature
        } else {
            0.0
        };
        (offset(best) + within * self.angle_step).clamp(-window, window)
    }

    /// `rotation` with its [`correction`](Self::correction), radians in [−π, π).
    #[must_use]
    pub fn tuned(&self, rotation: f64, window: f64) -> f64 {
        wrap_angle(rotation + self.correction(rotation, window))
    }
}

/// The first of the highest values among the chosen.
fn highest(values: &[f64], chosen: impl Fn(usize) -> bool) -> Option<usize> {
    let mut best: Option<usize> = None;
    for index in (0..values.len()).filter(|&index| chosen(index)) {
        if best.is_none_or(|best| values[index] > values[best]) {
            best = Some(index);
        }
    }
    best
}

fn check(target: &RadonImage, source: &RadonImage, rotation: f64) -> Result<(), RadonError> {
    let (target, source_) = (target.bins.height(), source.bins.height());
    if target != source_ {
        return Err(RadonError::DifferentAngles { target, source_ });
    }
    Ok(require(rotation.is_finite(), "rotation", "finite", rotation)?)
}

#[cfg(test)]
mod tests {
    use super::{RotationCorrelation, peak_correction, tune_by_peaks};
    use crate::{RadonError, radon};
    use nalgebra::Point2;
    use ogm_core::{Se2, wrap_angle};
    use proptest::prelude::{prop_assert, proptest};
    use std::f64::consts::PI;

    /// A long wall, a shorter one across, and a slanted one, in points a cell apart.
    fn walls(map_from_walls: Se2) -> Vec<Point2<f64>> {
        let step = |count: u32| (0..count).map(|i| f64::from(i) * 0.05);
        let long = step(160).map(|s| Point2::new(s, 0.0));
        let across = step(90).map(|s| Point2::new(8.0, s));
        let slanted = step(40).map(|s| Point2::new(2.0 + 0.8 * s, 2.0 + 0.6 * s));
        long.chain(across).chain(slanted).map(|point| map_from_walls * point).collect()
    }

    #[test]
    fn t_s5_peaks_on_both_sides_of_the_cut_are_close() {
        let correction = peak_correction(1.0_f64.to_radians(), 179.0_f64.to_radians());
        assert!((correction.to_degrees() - 2.0).abs() < 1e-9);
        let printed = peak_correction(90.0_f64.to_radians(), 94.0_f64.to_radians());
        assert!((printed.to_degrees() + 4.0).abs() < 1e-9, "added, whatever the text says");
    }

    #[test]
    fn both_tunings_find_how_far_a_rotation_is_off() {
        // Peaks are as broad as the longest wall is short, so finer steps do not sharpen them.
        for (true_degrees, step, by_peaks) in
            [(4.0, 1.0, true), (-4.0, 1.0, true), (8.0, 1.0, true), (-2.25, 0.25, false)]
        {
            let image = |turn: f64| {
                let points = walls(Se2::new(3.0, 1.0, turn));
                radon(&points, 0.05, f64::to_radians(step)).unwrap().unwrap()
            };
            let approximate = 100.0_f64.to_radians();
            let (target, source) = (image(approximate + f64::to_radians(true_degrees)), image(0.0));
            let window = 12.0_f64.to_radians();
            let peaks = tune_by_peaks(&target, &source, approximate, window).unwrap();
            let correlation = RotationCorrelation::between(&target, &source).unwrap();
            let correlated = correlation.correction(approximate, window);
            for ours in [by_peaks.then_some(peaks), Some(correlated)].into_iter().flatten() {
                let error = ours.to_degrees() - true_degrees;
                assert!(error.abs() < 0.4, "{true_degrees}: off by {error}");
            }
        }
    }

    #[test]
    fn images_of_other_angles_cannot_be_compared() {
        let image = |step| radon(&walls(Se2::identity()), 0.05, step).unwrap().unwrap();
        let (fine, coarse) = (image(0.01), image(0.02));
        let compared = RotationCorrelation::between(&fine, &coarse);
        assert!(matches!(compared, Err(RadonError::DifferentAngles { .. })));
        assert!(tune_by_peaks(&fine, &fine, f64::NAN, 0.1).is_err());
        assert!(tune_by_peaks(&fine, &fine, 0.0, 2.0).is_err());
    }

    proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(32))]
        #[test]
        fn a_correction_stays_in_its_window_and_turns_with_the_maps(
            turn in -PI..PI, error in -0.1_f64..0.1, window in 0.0_f64..0.3,
        ) {
            let step = 1.0_f64.to_radians();
            let image = |turn: f64| {
                radon(&walls(Se2::new(0.0, 0.0, turn)), 0.05, step).unwrap().unwrap()
            };
            let source = image(0.3);
            let correlation = RotationCorrelation::between(&image(0.3 + turn), &source).unwrap();
            prop_assert!(correlation.correction(turn - error, window).abs() <= window);
            let tuned = correlation.tuned(turn - error, 0.2);
            prop_assert!(wrap_angle(tuned - turn).abs() <= step, "{tuned} {turn}");
        }
    }
}
