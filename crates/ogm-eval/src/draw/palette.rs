//! Colours of charts and heat maps that stay apart for colour-blind readers.

use image::Rgb;
use ogm_view::UNKNOWN;

/// Series colours: those of Okabe and Ito, *Color universal design*, without yellow, which a white
/// panel swallows.
const SERIES: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];

/// Axes, ticks and text.
pub(crate) const INK: &str = "#333333";
/// Grid lines.
pub(crate) const FAINT: &str = "#dddddd";

/// The colour of series `index`; they repeat after seven.
pub(crate) fn series(index: usize) -> &'static str {
    SERIES[index % SERIES.len()]
}

/// Stops of viridis (Smith and van der Walt), evenly spaced.
const VIRIDIS: [[f64; 3]; 10] = [
    [68.0, 1.0, 84.0],
    [72.0, 40.0, 120.0],
    [62.0, 74.0, 137.0],
    [49.0, 104.0, 142.0],
    [38.0, 130.0, 142.0],
    [31.0, 158.0, 137.0],
    [53.0, 183.0, 121.0],
    [110.0, 206.0, 88.0],
    [181.0, 222.0, 43.0],
    [253.0, 231.0, 37.0],
];

/// The colour of `share` in [0, 1] on a ramp that gets lighter all the way.
pub(crate) fn ramp(share: f64) -> Rgb<u8> {
    let position = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let pairs = VIRIDIS.windows(2).zip(0_u32..);
    let passed = pairs.take_while(|&(_, start)| f64::from(start) <= position);
    passed.last().map_or(UNKNOWN, |(stops, start)| {
        let share = position - f64::from(start);
        let channel = |i: usize| to_byte(stops[0][i] + share * (stops[1][i] - stops[0][i]));
        Rgb([channel(0), channel(1), channel(2)])
    })
}

/// The nearest byte; saturates.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturation is documented"
)]
fn to_byte(value: f64) -> u8 {
    value.round() as u8
}

#[cfg(test)]
mod tests {
    use super::{VIRIDIS, ramp};
    use image::Rgb;
    use ogm_view::UNKNOWN;

    #[test]
    fn the_ramp_gets_lighter_all_the_way() {
        let lightness = |share: f64| {
            let Rgb([r, g, b]) = ramp(share);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for step in 0..50 {
            let (low, high) = (f64::from(step) / 50.0, f64::from(step + 1) / 50.0);
            assert!(lightness(low) + 0.5 < lightness(high), "{low} to {high}");
        }
    }

    #[test]
    fn the_ends_of_the_ramp_are_its_stops() {
        assert_eq!(ramp(-1.0), Rgb([68, 1, 84]));
        assert_eq!(ramp(2.0), Rgb([253, 231, 37]));
        assert_eq!(ramp(f64::NAN), UNKNOWN);
        assert_eq!(VIRIDIS[0], [68.0, 1.0, 84.0]);
    }
}
