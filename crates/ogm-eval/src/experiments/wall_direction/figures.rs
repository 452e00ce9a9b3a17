//! The figures of X3: lines after each stage, the OGM vector, and its spread.

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};
use ogm_core::{OccupancyGrid, Segment};
use ogm_vector::{angle_histogram, ogm_vector};

use super::record::{errors_deg, heading_of};
use crate::draw::{
    Bars, Chart, Histogram, Layer, Mark, Plan, Series, bars, chart, histogram, plan,
};
use crate::measured::{Measured, Run, RunResult, Timing};
use crate::report::{Figure, Image};

/// Draws one extraction with the defaults, and the spread and the times of all.
pub(super) fn draw(
    map: &OccupancyGrid,
    measured: &Measured,
    seed: u64,
) -> anyhow::Result<Vec<Figure>> {
    let runs = &measured.runs;
    let mut figures = Vec::new();
    let params = line_ransac::Params { seed, ..line_ransac::Params::default() };
    if let Some(extraction) = line_ransac::extract_segments(map, &params).found() {
        let kept = extraction.segments.iter().map(|s| [s.start, s.end]).collect();
        for (name, what, lines) in [
            ("lines-detected", "as voted for", extraction.stages.detected),
            ("lines-broken", "broken at gaps", extraction.stages.broken),
            ("lines-joined", "joined", extraction.stages.joined),
            ("lines-kept", "long and reliable", kept),
        ] {
            let title = format!("{} lines, {what}", lines.len());
            let layer = Layer { name: "lines".to_owned(), lines, ..Layer::default() };
            figures.push(Figure {
                name: name.to_owned(),
                caption: format!("Lines of plan A after a stage of the extraction: {what}."),
                image: Image::Svg(plan(&Plan {
                    title,
                    background: Some(map),
                    layers: vec![layer],
                })?),
            });
        }
        figures.push(by_direction(&extraction.segments));
        if let Some(vector) =
            ogm_vector(&extraction.segments, &ogm_vector::Params::default()).found()
        {
            figures.push(vector_figure(map, &vector)?);
        }
    }
    for (id, what) in [("X3a", "paper's values, printed weights"), ("X3c", "defaults")] {
        let values: Vec<f64> = errors_deg(runs, id).iter().map(|error| error - 45.0).collect();
        figures.push(Figure {
            name: format!("angles-{}", id.to_lowercase()),
            caption: format!("{id}: angle of the OGM vector over all extractions, {what}."),
            image: Image::Svg(histogram(&Histogram {
                title: format!("{id}: {what}"),
                x_label: "angle of the OGM vector, degrees".to_owned(),
                values: &values,
                bins: 40,
                marks: vec![("truth".to_owned(), -45.0)],
            })),
        });
    }
    figures.push(by_heading(runs));
    figures.push(times(&measured.timings));
    Ok(figures)
}

/// How much wall runs in which direction, in bins of four degrees around those of the axes.
fn by_direction(segments: &[Segment]) -> Figure {
    let metres = angle_histogram(segments, 45);
    let named = |bin: usize| {
        if bin.is_multiple_of(11) {
            format!("{}°", bin as f64 * 4.0 - 88.0)
        } else {
            String::new()
        }
    };
    Figure {
        name: "walls-by-direction".to_owned(),
        caption: "Metres of wall of plan A by direction, from the x axis of its map.".to_owned(),
        image: Image::Svg(bars(&Bars {
            title: "Walls by direction".to_owned(),
            y_label: "wall, m".to_owned(),
            log_y: false,
            groups: (0..metres.len()).map(named).collect(),
            series: vec![("long and reliable".to_owned(), metres)],
        })),
    }
}

/// How long the extractions of X3a took.
fn times(timings: &[Timing]) -> Figure {
    let chosen = timings.iter().filter(|timing| timing.experiment == "X3a");
    let values: Vec<f64> = chosen.map(|timing| timing.milliseconds).collect();
    Figure {
        name: "times-x3a".to_owned(),
        caption: "X3a: time from the map to its OGM vector; the paper's mean is 939 ms.".to_owned(),
        image: Image::Svg(histogram(&Histogram {
            title: "X3a: time of an extraction".to_owned(),
            x_label: "ms".to_owned(),
            values: &values,
            bins: 40,
            marks: Vec::new(),
        })),
    }
}

/// Errors of X3d over the heading of the map.
fn by_heading(runs: &[Run]) -> Figure {
    let mut errors: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    let mut dots = Vec::new();
    for run in runs.iter().filter(|run| run.experiment == "X3d") {
        if let (RunResult::Direction(error), Some(heading)) = (&run.result, heading_of(run)) {
            dots.push((heading, error.to_degrees()));
            errors.entry(heading.to_bits()).or_default().push(error.to_degrees());
        }
    }
    // Positive numbers are ordered as their bits are.
    let means = errors
        .iter()
        .filter_map(|(bits, errors)| Some((f64::from_bits(*bits), crate::stats::mean(errors)?)));
    let means = means.collect();
    let series = |name: &str, points, mark| Series { name: name.to_owned(), points, mark };
    Figure {
        name: "angles-by-heading".to_owned(),
        caption: "X3d: error of the OGM vector over the heading of the map.".to_owned(),
        image: Image::Svg(chart(&Chart {
            title: "X3d: defaults on a turned map".to_owned(),
            x_label: "heading of the map, degrees".to_owned(),
            y_label: "error, degrees".to_owned(),
            log_y: false,
            series: vec![
                series("extraction", dots, Mark::Dots),
                series("mean", means, Mark::DottedLine),
            ],
        })),
    }
}

fn vector_figure(map: &OccupancyGrid, vector: &ogm_vector::OgmVector) -> anyhow::Result<Figure> {
    let centre = Point2::new(map.width() as f64 / 2.0, map.height() as f64 / 2.0);
    let centre = map.frame().point_from_cells(centre);
    let arrow = |angle: f64, length: f64| {
        [centre, centre + Vector2::new(angle.cos(), angle.sin()) * length]
    };
    let walls =
        vector.group_directions().iter().flatten().map(|&angle| arrow(angle, 3.0)).collect();
    let bisector = vec![arrow(vector.theta_ogm(), 4.0)];
    let layer = |name: &str, lines| Layer {
        name: name.to_owned(),
        lines,
        arrows: true,
        ..Layer::default()
    };
    Ok(Figure {
        name: "ogm-vector".to_owned(),
        caption: "The two wall directions of plan A and the OGM vector between them.".to_owned(),
        image: Image::Svg(plan(&Plan {
            title: format!("OGM vector at {:.2}°", vector.theta_ogm().to_degrees()),
            background: Some(map),
            layers: vec![layer("wall directions", walls), layer("OGM vector", bisector)],
        })?),
    })
}
