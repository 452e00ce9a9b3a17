//! Lines and points over two axes.

use super::axes::{Axes, Labels, Scale};
use super::palette::series;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Joined by a line.
    Line,
    /// Joined by a dashed line, for what is a reference and not a measurement.
    Dashed,
    /// Dots.
    Dots,
    /// Joined dots.
    DottedLine,
}

/// Points of one kind.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// Its name in the legend.
    pub(crate) name: String,
    /// (x, y); one that cannot be drawn (not finite, or not positive on a logarithmic axis) is
    /// left out and breaks the line.
    pub(crate) points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub(crate) mark: Mark,
}

/// Several series over common axes.
#[derive(Debug, Clone)]
pub(crate) struct Chart {
    /// Stands above the panel.
    pub(crate) title: String,
    /// Quantity and unit of x.
    pub(crate) x_label: String,
    /// Quantity and unit of y.
    pub(crate) y_label: String,
    /// Whether y is logarithmic.
    pub(crate) log_y: bool,
    /// In the order of the legend.
    pub(crate) series: Vec<Series>,
}

/// The chart as SVG.
pub(crate) fn chart(chart: &Chart) -> String {
    let points = || chart.series.iter().flat_map(|series| &series.points);
    let labels = Labels {
        title: &chart.title,
        x: &chart.x_label,
        y: &chart.y_label,
        legend: chart.series.iter().map(|series| series.name.as_str()).collect(),
    };
    let x = Scale::over(points().map(|point| point.0), false, 0.02);
    let y = Scale::over(points().map(|point| point.1), chart.log_y, 0.04);
    let mut axes = Axes::new(&labels, x, y, None);
    for (index, one) in chart.series.iter().enumerate() {
        let colour = series(index);
        let pixels: Vec<_> = one.points.iter().map(|&(x, y)| axes.at(x, y)).collect();
        if one.mark != Mark::Dots {
            for run in pixels.split(Option::is_none).filter(|run| run.len() > 1) {
                let run: Vec<[f64; 2]> = run.iter().copied().flatten().collect();
                axes.svg.path(&run, colour, one.mark == Mark::Dashed);
            }
        }
        if matches!(one.mark, Mark::Dots | Mark::DottedLine) {
            for &pixel in pixels.iter().flatten() {
                axes.svg.dot(pixel, 2.6, colour);
            }
        }
    }
    axes.svg.finish()
}

#[cfg(test)]
mod tests {
    use super::{Chart, Mark, Series, chart};

    fn picture(log_y: bool, points: &[(f64, f64)], mark: Mark) -> String {
        chart(&Chart {
            title: "Error <px²>".into(),
            x_label: "turn".into(),
            y_label: "error".into(),
            log_y,
            series: vec![Series { name: "one".into(), points: points.to_vec(), mark }],
        })
    }

    #[test]
    fn a_point_that_cannot_be_drawn_breaks_the_line() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, 4.0), (4.0, 5.0)];
        assert_eq!(picture(false, &points, Mark::Line).matches("<polyline").count(), 2);
        let with_zero = [(0.0, 1.0), (1.0, 0.0), (2.0, 10.0)];
        assert_eq!(picture(true, &with_zero, Mark::Dots).matches("<circle").count(), 2);
        assert_eq!(picture(false, &with_zero, Mark::Dots).matches("<circle").count(), 3);
    }

    #[test]
    fn higher_values_lie_higher_and_text_is_escaped() {
        let svg = picture(false, &[(0.0, 0.0), (1.0, 1.0)], Mark::Line);
        let points = svg.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let y = |index: usize| -> f64 {
            let pair = points.split(' ').nth(index).unwrap();
            pair.split(',').nth(1).unwrap().parse().unwrap()
        };
        assert!(y(1) < y(0), "y grows upwards: {points}");
        assert!(svg.contains("Error &lt;px²&gt;") && !svg.contains("NaN"));
    }

    #[test]
    fn a_chart_of_nothing_is_an_empty_panel() {
        let svg = picture(true, &[], Mark::DottedLine);
        assert!(!svg.contains("NaN") && !svg.contains("inf") && svg.ends_with("</svg>\n"));
    }
}
