//! Figures 5 to 7 of Saeedi et al.: the scans that make edges one line, and what tells a featured
//! segment from a straight one.

use anyhow::Context;
use nalgebra::Point2;
use ogm_core::{CellIndex, Grid};
use ogm_view::{png, side_by_side};
use radon_merge::{WallSegment, signature, smooth_edges};

use crate::draw::{Heat, Histogram, heat, histogram};
use crate::report::{Figure, Image};

/// Bins of a histogram.
const BINS: usize = 10;

/// Distances and arcs of a straight wall of the same length as the featured one, and of that.
pub(super) fn draw(featured: &WallSegment) -> anyhow::Result<Vec<Figure>> {
    let count = u32::try_from(featured.points.len()).unwrap_or(u32::MAX);
    let straight: Vec<Point2<f64>> =
        (0..count).map(|index| Point2::new(0.05 * f64::from(index), 0.0)).collect();
    let mut figures = vec![scans()?];
    for (name, figure, points) in [("straight", 6, &straight), ("featured", 7, &featured.points)] {
        let signature = signature(points).context("a segment has a signature")?;
        for (what, values) in [("distance", &signature.distance), ("arc", &signature.arc)] {
            figures.push(Figure {
                name: format!("x6-fig{figure}-{what}"),
                caption: format!("Figure {figure}: the {what}s of a {name} wall segment."),
                image: Image::Svg(histogram(&Histogram {
                    title: format!("A {name} segment"),
                    x_label: format!("{what}, m"),
                    values,
                    bins: BINS,
                    marks: Vec::new(),
                })),
            });
        }
    }
    Ok(figures)
}

/// Figure 5: both sides of a wall become one line.
fn scans() -> anyhow::Result<Figure> {
    let mut edges = Grid::filled(32, 24, false)?;
    for inset in [4_usize, 7] {
        for row in inset..24 - inset {
            for column in inset..32 - inset {
                let is_edge =
                    row == inset || row == 23 - inset || column == inset || column == 31 - inset;
                if let Some(cell) = edges.get_mut(CellIndex { column, row }).filter(|_| is_edge) {
                    *cell = true;
                }
            }
        }
    }
    let smoothed = smooth_edges(&edges, 4);
    let style = Heat { upscale: 8, ..Heat::default() };
    let panel = |mask: &Grid<bool>| heat(&mask.map(|&set| if set { 1.0 } else { 0.0 }), &style);
    Ok(Figure {
        name: "x6-fig5-smoothing".to_owned(),
        caption: "Figure 5: the edges of a simple map, and what the scans make of them.".to_owned(),
        image: Image::Png(png(&side_by_side(&[panel(&edges)?, panel(&smoothed)?], 8))?),
    })
}
