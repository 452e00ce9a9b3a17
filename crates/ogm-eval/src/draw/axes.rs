//! The frame of a chart: from data to pixels, ticks, labels, legend.

use super::palette::{FAINT, INK, series};
use super::svg::{Anchor, Svg};

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 340.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 48.0;
const LEGEND_ROW: f64 = 18.0;
const LEGEND_GAP: f64 = 6.0;

/// How data values become positions along an axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    from: f64,
    to: f64,
    log: bool,
}

impl Scale {
    /// A scale over all that is drawable of `values`: a logarithmic one ends at powers of ten, a
    /// linear one leaves `room` of its span at both ends.
    pub(crate) fn over(values: impl IntoIterator<Item = f64>, log: bool, room: f64) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            if value.is_finite() && (!log || value > 0.0) {
                let value = if log { value.log10() } else { value };
                (low, high) = (low.min(value), high.max(value));
            }
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if log {
            // A bar of the least value still has a length.
            return Self { from: (low - 0.05).floor(), to: high.ceil(), log };
        }
        // One value, or values that differ by rounding only, still need a span.
        if high - low <= 1e-12 * high.abs().max(low.abs()).max(1e-290) {
            let half = if low == 0.0 { 0.5 } else { low.abs() / 10.0 };
            (low, high) = (low - half, high + half);
        }
        let margin = room * (high - low);
        Self { from: low - margin, to: high + margin, log }
    }

    /// The lower end of the axis.
    pub(crate) fn start(&self) -> f64 {
        self.value(self.from)
    }

    /// Position in [0, 1] along the axis, or `None` if the value cannot be drawn.
    fn share(&self, value: f64) -> Option<f64> {
        let position = if self.log { value.log10() } else { value };
        position.is_finite().then(|| (position - self.from) / (self.to - self.from))
    }

    fn value(&self, position: f64) -> f64 {
        if self.log { 10_f64.powf(position) } else { position }
    }

    /// About `count` round values on the axis with their labels.
    fn ticks(&self, count: f64) -> Vec<(f64, String)> {
        let step = if self.log {
            ((self.to - self.from) / count).ceil()
        } else {
            round_step((self.to - self.from) / count)
        };
        let mut ticks = Vec::new();
        let mut position = (self.from / step - 1e-9).ceil() * step;
        while position <= self.to + 1e-9 * step && ticks.len() < 50 {
            let value = self.value(position);
            let label = if self.log { power_of_ten(value) } else { decimal(position, step) };
            ticks.push((value, label));
            position += step;
        }
        ticks
    }
}

/// The next of 1, 2, 5 × 10ⁿ.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factors = [1.0, 2.0, 5.0];
    let factor = factors.into_iter().find(|factor| factor * power >= step * 0.999);
    factor.unwrap_or(10.0) * power
}

fn power_of_ten(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        format!("{}", (value * 1e4).round() / 1e4)
    } else {
        format!("{value:.0e}")
    }
}

/// `value` with the decimals that tell multiples of `step` apart.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and 6 decimals"
)]
fn decimal(value: f64, step: f64) -> String {
    if step < 1e-6 || value.abs() >= 1e7 {
        return format!("{value:.1e}");
    }
    let decimals = (-(step * 1.001).log10().floor()).clamp(0.0, 6.0) as usize;
    let value = if value.abs() < step / 2.0 { 0.0 } else { value };
    format!("{value:.decimals$}")
}

/// What stands around the panel.
#[derive(Debug)]
pub(crate) struct Labels<'a> {
    pub(crate) title: &'a str,
    pub(crate) x: &'a str,
    pub(crate) y: &'a str,
    /// Names of the series; the legend is left out below two.
    pub(crate) legend: Vec<&'a str>,
}

/// A chart whose frame is drawn and whose data are not.
#[derive(Debug)]
pub(crate) struct Axes {
    pub(crate) svg: Svg,
    x: Scale,
    y: Scale,
}

impl Axes {
    /// Draws the frame; `x_ticks` replaces the numbers below the x axis.
    pub(crate) fn new(
        labels: &Labels<'_>,
        x: Scale,
        y: Scale,
        x_ticks: Option<Vec<(f64, String)>>,
    ) -> Self {
        let legend = legend_rows(&labels.legend);
        let svg = Svg::new(WIDTH, HEIGHT + LEGEND_ROW * legend.len() as f64 + LEGEND_GAP);
        let mut axes = Self { svg, x, y };
        let (right, base) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for (value, label) in y.ticks(6.0) {
            let Some(at) = axes.at(x.start(), value) else {
                continue;
            };
            axes.svg.line([LEFT, at[1]], [right, at[1]], FAINT, 1.0);
            axes.svg.text([LEFT - 8.0, at[1] + 4.0], Anchor::End, &label);
        }
        for (value, label) in x_ticks.unwrap_or_else(|| x.ticks(7.0)) {
            let Some(at) = axes.at(value, y.start()) else {
                continue;
            };
            axes.svg.line([at[0], base], [at[0], base + 5.0], INK, 1.0);
            axes.svg.text([at[0], base + 18.0], Anchor::Middle, &label);
        }
        axes.svg.line([LEFT, base], [right, base], INK, 1.0);
        axes.svg.line([LEFT, TOP], [LEFT, base], INK, 1.0);
        axes.svg.title([LEFT, 20.0], labels.title);
        axes.svg.text([(LEFT + right) / 2.0, HEIGHT - 10.0], Anchor::Middle, labels.x);
        axes.svg.upward_text([16.0, (TOP + base) / 2.0], labels.y);
        for (row, entries) in legend.iter().enumerate() {
            let y = HEIGHT + LEGEND_GAP + LEGEND_ROW * row as f64;
            for &(x, index) in entries {
                axes.svg.bar([x, y - 4.0], [x + 14.0, y + 4.0], series(index));
                axes.svg.text([x + 20.0, y + 4.0], Anchor::Start, labels.legend[index]);
            }
        }
        axes
    }

    /// The pixel of a data point, or `None` if it cannot be drawn.
    pub(crate) fn at(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let (x, y) = (self.x.share(x)?, self.y.share(y)?);
        Some([LEFT + x * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - y * (HEIGHT - TOP - BOTTOM)])
    }

    /// Labelled vertical lines through the panel; the labels stand on rows of their own.
    pub(crate) fn mark_x(&mut self, marks: &[(String, f64)]) {
        let base = self.y.start();
        let places = marks.iter().filter_map(|(label, x)| Some((label, self.at(*x, base)?[0])));
        let places: Vec<_> = places.collect();
        for &(_, x) in &places {
            self.svg.path(&[[x, TOP], [x, HEIGHT - BOTTOM]], INK, true);
        }
        for (row, &(label, x)) in places.iter().enumerate() {
            let y = TOP + 11.0 + 15.0 * row as f64;
            // In the right half the label stands before its line, so that it keeps inside.
            if x > WIDTH / 2.0 {
                self.svg.text_on_data([x - 5.0, y], Anchor::End, label);
            } else {
                self.svg.text_on_data([x + 5.0, y], Anchor::Start, label);
            }
        }
    }
}

/// Where each legend entry goes: rows of (x, series), broken by the estimated width of the names.
fn legend_rows(names: &[&str]) -> Vec<Vec<(f64, usize)>> {
    let mut rows: Vec<Vec<(f64, usize)>> = Vec::new();
    let mut x = f64::INFINITY;
    if names.len() < 2 {
        return rows;
    }
    for (index, name) in names.iter().enumerate() {
        let width = 36.0 + 6.8 * name.chars().count() as f64;
        if x + width > WIDTH - RIGHT {
            rows.push(Vec::new());
            x = LEFT;
        }
        if let Some(row) = rows.last_mut() {
            row.push((x, index));
        }
        x += width;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::{Scale, legend_rows};

    fn labels(scale: Scale) -> Vec<String> {
        scale.ticks(6.0).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_numbers_inside_the_axis() {
        let tenths = Scale::over([-0.21, 0.53], false, 0.0);
        assert_eq!(labels(tenths), ["-0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(labels(Scale::over([0.0, 700.0], false, 0.0)).last().unwrap(), "600");
        let powers = Scale::over([0.02, 18_000.0], true, 0.0);
        assert_eq!(labels(powers), ["0.01", "1", "100", "10000"]);
    }

    #[test]
    fn what_cannot_be_drawn_does_not_stretch_the_axis() {
        let log = Scale::over([0.0, -3.0, f64::NAN, 1.0, 100.0], true, 0.0);
        assert_eq!((log.start(), log.share(10.0)), (0.1, Some(2.0 / 3.0)));
        assert_eq!(log.share(0.0), None);
        for lonely in [vec![], vec![5.0], vec![0.0], vec![1e-300, 1e-300], vec![-1e9]] {
            let scale = Scale::over(lonely.clone(), false, 0.05);
            assert!(scale.to > scale.from, "{lonely:?}");
            assert!(!scale.ticks(6.0).is_empty(), "{lonely:?}");
        }
    }

    #[test]
    fn a_long_legend_breaks_into_rows() {
        let long = "a name that takes about half of the width";
        let rows = legend_rows(&[long, long, long]);
        assert_eq!(rows.iter().map(Vec::len).collect::<Vec<_>>(), [1, 1, 1]);
        assert!(legend_rows(&["one"]).is_empty());
    }
}
