//! The Radon transform of wall points.

use nalgebra::Point2;
use ogm_core::{Grid, require};
use std::f64::consts::PI;

use crate::RadonError;
use crate::approximate::box_centre;

/// Projections of wall points onto lines of every direction (Saeedi et al., section II.H).
///
/// Points and not pictures are projected: walls are a few cells in a hundred of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct RadonImage {
    /// A row for each angle θ, a column for each ρ: how many points have x cos θ + y sin θ = ρ,
    /// each shared between the two nearest bins. θ covers half a turn from 0; bins of ρ are as
    /// wide as the resolution, symmetric about the middle of the points.
    pub bins: Grid<f32>,
    /// Radians from one angle to the next: half a turn over the number of angles.
    pub angle_step: f64,
}

/// The Radon transform of `points` in bins of `resolution` metres, at steps of at most
/// `angle_step` radians that divide half a turn.
///
/// `None` if there are no points.
///
/// # Errors
/// A point that is not finite, a step or resolution that is not positive, or points so far apart
/// that the bins exceed the size limit of a grid.
pub fn radon(
    points: &[Point2<f64>],
    resolution: f64,
    angle_step: f64,
) -> Result<Option<RadonImage>, RadonError> {
    let step_ok = angle_step > 1e-5 && angle_step <= PI;
    require(step_ok, "angle_step", "above 1e-5 and at most half a turn", angle_step)?;
    let resolution_ok = resolution.is_finite() && resolution > 0.0;
    require(resolution_ok, "resolution", "finite and above 0", resolution)?;
    let not_finite = |point: &Point2<f64>| !(point.x.is_finite() && point.y.is_finite());
    if let Some(index) = points.iter().position(not_finite) {
        let point = points[index];
        return Err(RadonError::NonFinitePoint { index, x: point.x, y: point.y });
    }
    if points.is_empty() {
        return Ok(None);
    }
    let centre = box_centre(points);
    let cells: Vec<[f64; 2]> = points
        .iter()
        .map(|point| [(point.x - centre.x) / resolution, (point.y - centre.y) / resolution])
        .collect();
    let reach = cells.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, and the grid refuses what is too large"
    )]
    let (angles, half) = ((PI / angle_step - 1e-9).ceil() as usize, reach.ceil() as usize);
    let width = half.saturating_add(1).saturating_mul(2).saturating_add(1);
    let mut bins = Grid::filled(width, angles.max(1), 0.0_f32)?;
    let angle_step = PI / bins.height() as f64;
    let middle = half as f64 + 1.0;
    for (index, row) in bins.cells_mut().chunks_exact_mut(width).enumerate() {
        let (sin, cos) = (index as f64 * angle_step).sin_cos();
        for [x, y] in &cells {
            let rho = x * cos + y * sin + middle;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at least 0 and below the width"
            )]
            let bin = rho as usize;
            #[expect(clippy::cast_possible_truncation, reason = "a share needs no more")]
            let share = (rho - bin as f64) as f32;
            if let [near, next, ..] = &mut row[bin..] {
                *near += 1.0 - share;
                *next += share;
            }
        }
    }
    Ok(Some(RadonImage { bins, angle_step }))
}

impl RadonImage {
    /// For each angle the greatest bin: high where the angle is across a wall.
    #[must_use]
    pub fn peaks(&self) -> Vec<f64> {
        let greatest = |row: &[f32]| row.iter().copied().fold(0.0, f32::max);
        self.bins.rows().map(|row| f64::from(greatest(row))).collect()
    }

    /// For each angle the sum of the squared bins, which all walls of a direction enter and not
    /// only the longest.
    #[must_use]
    pub fn energy(&self) -> Vec<f64> {
        let sum = |row: &[f32]| row.iter().map(|&bin| f64::from(bin) * f64::from(bin)).sum();
        self.bins.rows().map(sum).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::radon;
    use crate::RadonError;
    use nalgebra::Point2;

    #[test]
    fn every_projection_holds_every_point_and_a_wall_peaks_across_itself() {
        let wall: Vec<_> = (0..100)
            .map(|i| f64::from(i) * 0.05)
            .map(|s| Point2::new(7.0 + s * 30.0_f64.to_radians().cos(), 3.0 + s * 0.5))
            .collect();
        let image = radon(&wall, 0.05, 1.0_f64.to_radians()).unwrap().unwrap();
        assert_eq!(image.bins.height(), 180);
        for row in image.bins.rows() {
            assert!((row.iter().sum::<f32>() - 100.0).abs() < 1e-3);
        }
        for profile in [image.peaks(), image.energy()] {
            let highest = (0..180).max_by(|&a, &b| profile[a].total_cmp(&profile[b]));
            assert_eq!(highest, Some(120), "a wall at 30° lies across 120°");
        }
    }

    #[test]
    fn no_points_have_no_image_and_wrong_ones_are_errors() {
        assert_eq!(radon(&[], 0.05, 0.01).unwrap(), None);
        let nan = [Point2::new(f64::NAN, 0.0)];
        assert!(matches!(radon(&nan, 0.05, 0.01), Err(RadonError::NonFinitePoint { .. })));
        let far = [Point2::new(0.0, 0.0), Point2::new(1e300, 0.0)];
        assert!(matches!(radon(&far, 0.05, 0.01), Err(RadonError::Grid(_))));
        for step in [0.0, -1.0, f64::NAN, 4.0] {
            assert!(radon(&[Point2::origin()], 0.05, step).is_err(), "{step}");
        }
        assert!(radon(&[Point2::origin()], 0.05, 0.01).unwrap().is_some(), "one point has one");
    }
}
