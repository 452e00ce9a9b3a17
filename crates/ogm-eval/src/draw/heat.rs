//! Fields of numbers as heat maps.

use image::RgbImage;
use ogm_core::Grid;
use ogm_view::{UNKNOWN, enlarge, paint, reduce};

use super::palette::ramp;

/// How a field becomes colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Heat {
    /// Exponent on the share of the range: below 1 it lifts faint values. Positive.
    pub(crate) gamma: f64,
    /// Values at the dark and at the light end; `None` takes the least and the greatest.
    pub(crate) range: Option<(f64, f64)>,
    /// Pixels a cell.
    pub(crate) upscale: u32,
    /// Columns and rows to show, each from and to, the latter exclusive; `None` shows all. What
    /// lies outside the field is left out.
    pub(crate) window: Option<[(usize, usize); 2]>,
}

impl Default for Heat {
    fn default() -> Self {
        Self { gamma: 1.0, range: None, upscale: 1, window: None }
    }
}

/// The field in colours that get lighter with the value; what is not finite is grey. Where a pixel
/// holds several cells it shows the greatest, so that narrow peaks stay.
///
/// # Errors
/// A window that holds no cell.
pub(crate) fn heat(field: &Grid<f64>, style: &Heat) -> anyhow::Result<RgbImage> {
    let [columns, rows] = style.window.unwrap_or([(0, field.width()), (0, field.height())]);
    let clip = |(from, to): (usize, usize), size: usize| (from.min(size), to.min(size));
    let (columns, rows) = (clip(columns, field.width()), clip(rows, field.height()));
    let (width, height) = (columns.1.saturating_sub(columns.0), rows.1.saturating_sub(rows.0));
    let cells = field.rows().skip(rows.0).take(height);
    let cells = cells.flat_map(|row| row[columns.0..].iter().take(width)).copied().collect();
    let shown = reduce(&Grid::new(width, height, cells)?, f64::max);

    let finite = || shown.cells().iter().copied().filter(|value| value.is_finite());
    let (low, high) = style.range.unwrap_or_else(|| {
        (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max))
    });
    let image = paint(&shown, |&value| {
        if value.is_finite() {
            // A field of one value is all dark.
            let share = if high > low { (value - low) / (high - low) } else { 0.0 };
            ramp(share.clamp(0.0, 1.0).powf(style.gamma))
        } else {
            UNKNOWN
        }
    });
    Ok(enlarge(&image, style.upscale))
}

#[cfg(test)]
mod tests {
    use super::{Heat, heat};
    use crate::draw::palette::ramp;
    use ogm_core::Grid;
    use ogm_view::UNKNOWN;

    fn field() -> Grid<f64> {
        Grid::new(3, 2, vec![0.0, 0.25, 1.0, f64::NAN, 0.5, 0.0]).unwrap()
    }

    #[test]
    fn values_spread_over_the_ramp_and_gamma_lifts_faint_ones() {
        let plain = heat(&field(), &Heat::default()).unwrap();
        assert_eq!(*plain.get_pixel(1, 1), ramp(0.25));
        assert_eq!(*plain.get_pixel(2, 1), ramp(1.0));
        assert_eq!(*plain.get_pixel(0, 0), UNKNOWN);
        let lifted = Heat { gamma: 0.5, ..Heat::default() };
        assert_eq!(*heat(&field(), &lifted).unwrap().get_pixel(1, 1), ramp(0.5));
    }

    #[test]
    fn a_window_crops_before_it_scales() {
        let style = Heat { upscale: 4, window: Some([(1, 9), (0, 1)]), ..Heat::default() };
        let image = heat(&field(), &style).unwrap();
        assert_eq!(image.dimensions(), (8, 4));
        assert_eq!(*image.get_pixel(3, 3), ramp(0.0), "the least value in the window");
        assert_eq!(*image.get_pixel(4, 0), ramp(1.0));
        let empty = Heat { window: Some([(3, 9), (0, 1)]), ..Heat::default() };
        assert!(heat(&field(), &empty).is_err());
    }

    #[test]
    fn a_flat_field_and_a_field_of_nothing_are_pictures_too() {
        let flat = Grid::filled(2, 1, 7.0).unwrap();
        assert_eq!(*heat(&flat, &Heat::default()).unwrap().get_pixel(0, 0), ramp(0.0));
        let nothing = Grid::filled(2, 1, f64::NAN).unwrap();
        assert_eq!(*heat(&nothing, &Heat::default()).unwrap().get_pixel(0, 0), UNKNOWN);
    }
}
