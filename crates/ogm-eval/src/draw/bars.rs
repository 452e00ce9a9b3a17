//! Bars: values of categories, and how often values occur.

use super::axes::{Axes, Labels, Scale};
use super::palette::series;

/// Values of several series in several groups, as bars side by side.
#[derive(Debug, Clone)]
pub(crate) struct Bars {
    /// Stands above the panel.
    pub(crate) title: String,
    /// Quantity and unit of y.
    pub(crate) y_label: String,
    /// Whether y is logarithmic; bars then start a little below the least value.
    pub(crate) log_y: bool,
    /// Names below the x axis.
    pub(crate) groups: Vec<String>,
    /// Name and one value a group; one that cannot be drawn is left out.
    pub(crate) series: Vec<(String, Vec<f64>)>,
}

/// How often values occur, in bins of equal width.
#[derive(Debug, Clone)]
pub(crate) struct Histogram<'a> {
    /// Stands above the panel.
    pub(crate) title: String,
    /// Quantity and unit of the values.
    pub(crate) x_label: String,
    /// Values in any order; those that are not finite are left out.
    pub(crate) values: &'a [f64],
    /// Number of bins, at least 1.
    pub(crate) bins: usize,
    /// Vertical lines: a name, such as "truth", and where.
    pub(crate) marks: Vec<(String, f64)>,
}

/// The bars as SVG.
pub(crate) fn bars(bars: &Bars) -> String {
    let values = bars.series.iter().flat_map(|(_, values)| values.iter().copied());
    // On a linear axis a bar means its length, so zero belongs to the axis.
    let zero = (!bars.log_y).then_some(0.0);
    let y = Scale::over(values.chain(zero), bars.log_y, 0.04);
    let x = Scale::over([-0.5, bars.groups.len() as f64 - 0.5], false, 0.0);
    let labels = Labels {
        title: &bars.title,
        x: "",
        y: &bars.y_label,
        legend: bars.series.iter().map(|(name, _)| name.as_str()).collect(),
    };
    let ticks = bars.groups.iter().enumerate().map(|(group, name)| (group as f64, name.clone()));
    let mut axes = Axes::new(&labels, x, y, Some(ticks.collect()));
    let foot = zero.unwrap_or(y.start());
    let width = 0.8 / bars.series.len().max(1) as f64;
    for (index, (_, values)) in bars.series.iter().enumerate() {
        for (group, &value) in values.iter().enumerate().take(bars.groups.len()) {
            let left = group as f64 - 0.4 + width * index as f64;
            let corners = axes.at(left, foot).zip(axes.at(left + width * 0.94, value));
            if let Some((a, b)) = corners {
                axes.svg.bar(a, b, series(index));
            }
        }
    }
    axes.svg.finish()
}

/// The histogram as SVG.
pub(crate) fn histogram(histogram: &Histogram<'_>) -> String {
    let counted = Counts::of(histogram.values, histogram.bins);
    let marks = histogram.marks.iter().map(|&(_, at)| at);
    let x = Scale::over(marks.chain([counted.from, counted.to]), false, 0.02);
    let most = counted.counts.iter().max().copied().unwrap_or(0);
    let y = Scale::over([0.0, 1.05 * most.max(1) as f64], false, 0.0);
    let labels =
        Labels { title: &histogram.title, x: &histogram.x_label, y: "count", legend: Vec::new() };
    let mut axes = Axes::new(&labels, x, y, None);
    let width = (counted.to - counted.from) / counted.counts.len() as f64;
    for (bin, &count) in counted.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = counted.from + width * bin as f64;
        let corners = axes.at(left, 0.0).zip(axes.at(left + width, count as f64));
        if let Some(([x0, y0], [x1, y1])) = corners {
            axes.svg.bar([x0, y0], [(x1 - 0.6).max(x0 + 0.6), y1], series(0));
        }
    }
    axes.mark_x(&histogram.marks);
    axes.svg.finish()
}

/// Values counted into bins of equal width over [from, to].
#[derive(Debug, PartialEq)]
struct Counts {
    from: f64,
    to: f64,
    counts: Vec<usize>,
}

impl Counts {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a finite value at or above the least; the last bin takes the greatest"
    )]
    fn of(values: &[f64], bins: usize) -> Self {
        let bins = bins.max(1);
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let (mut from, mut to) =
            finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if from > to {
            (from, to) = (0.0, 1.0);
        } else if from == to {
            let half = if from == 0.0 { 0.5 } else { from.abs() / 20.0 };
            (from, to) = (from - half, to + half);
        }
        let mut counts = vec![0; bins];
        for value in finite() {
            let bin = (value - from) / (to - from) * bins as f64;
            counts[(bin as usize).min(bins - 1)] += 1;
        }
        Self { from, to, counts }
    }
}

#[cfg(test)]
mod tests {
    use super::{Bars, Counts, Histogram, bars, histogram};

    #[test]
    fn every_finite_value_is_counted_once() {
        let counted = Counts::of(&[0.0, 0.1, 0.5, 1.0, f64::NAN, f64::INFINITY], 2);
        assert_eq!((counted.from, counted.to), (0.0, 1.0));
        assert_eq!(counted.counts, [2, 2]);
        assert_eq!(Counts::of(&[3.0; 4], 5).counts, [0, 0, 4, 0, 0]);
        assert_eq!(Counts::of(&[], 0).counts, [0]);
    }

    #[test]
    fn bars_are_as_long_as_their_values() {
        let svg = bars(&Bars {
            title: String::new(),
            y_label: String::new(),
            log_y: false,
            groups: vec!["a".into(), "b".into(), "c".into()],
            series: vec![("one".into(), vec![1.0, -2.0, f64::NAN])],
        });
        let height = |index: usize| -> f64 {
            let bar = svg.split("<rect x=").nth(index + 1).unwrap();
            bar.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        assert!((height(1) / height(0) - 2.0).abs() < 1e-3);
        assert_eq!(svg.matches("<rect x=").count(), 2, "a NaN has no bar");
    }

    #[test]
    fn marks_outside_the_values_widen_the_axis() {
        let svg = histogram(&Histogram {
            title: "Turn".into(),
            x_label: "degrees".into(),
            values: &[1.0, 1.1, 1.2],
            bins: 10,
            marks: vec![("truth".into(), 0.0)],
        });
        assert!(svg.contains(">truth<") && svg.contains("stroke-dasharray"));
        let dashed = svg.split("<polyline points=\"").nth(1).unwrap();
        let x: f64 = dashed.split(',').next().unwrap().parse().unwrap();
        assert!((70.0..544.0).contains(&x), "{x}");
    }
}
