//! Walls, points and arrows in metres, over a map.

use nalgebra::Point2;
use ogm_core::OccupancyGrid;
use ogm_view::{crop_known, occupancy, png};

use super::embed::png_data_uri;
use super::palette::{INK, series};
use super::svg::{Anchor, Svg, round};

/// Pixels of the longer side.
const SIDE: f64 = 560.0;
const MARGIN: f64 = 16.0;
const TITLE: f64 = 26.0;
const LEGEND_ROW: f64 = 18.0;

/// What is drawn in one colour.
#[derive(Debug, Clone, Default)]
pub(crate) struct Layer {
    /// Its name in the legend.
    pub(crate) name: String,
    /// Straight pieces from start to end, metres.
    pub(crate) lines: Vec<[Point2<f64>; 2]>,
    /// Whether each line ends in an arrow head.
    pub(crate) arrows: bool,
    /// Dots, metres.
    pub(crate) points: Vec<Point2<f64>>,
}

/// A drawing in the frame of one map.
#[derive(Debug, Clone)]
pub(crate) struct Plan<'a> {
    /// Stands above the drawing.
    pub(crate) title: String,
    /// A map to draw under the layers, in the same frame.
    pub(crate) background: Option<&'a OccupancyGrid>,
    /// From the lowest up.
    pub(crate) layers: Vec<Layer>,
}

/// The plan as SVG, x to the right and y up.
///
/// # Errors
/// A background that cannot be encoded, or nothing with a finite position to draw.
pub(crate) fn plan(plan: &Plan<'_>) -> anyhow::Result<String> {
    let background = plan.background.map(crop_known).transpose()?;
    let sheet = Sheet::around(corners(plan, background.as_ref()))?;
    let legend = plan.layers.iter().filter(|layer| !layer.name.is_empty()).count();
    let height = sheet.height + LEGEND_ROW * legend as f64 + MARGIN;
    let mut svg = Svg::new(sheet.width.max(240.0), height);
    svg.title([MARGIN, 18.0], &plan.title);
    if let Some(map) = &background {
        draw_map(&mut svg, &sheet, map)?;
    }
    let mut legend_y = sheet.height + 4.0;
    for (index, layer) in plan.layers.iter().enumerate() {
        let colour = series(index);
        for &[start, end] in &layer.lines {
            draw_line(&mut svg, [sheet.at(start), sheet.at(end)], layer.arrows, colour);
        }
        for &point in &layer.points {
            svg.dot(sheet.at(point), 4.0, colour);
        }
        if !layer.name.is_empty() {
            svg.bar([MARGIN, legend_y - 4.0], [MARGIN + 14.0, legend_y + 4.0], colour);
            svg.text([MARGIN + 20.0, legend_y + 4.0], Anchor::Start, &layer.name);
            legend_y += LEGEND_ROW;
        }
    }
    draw_scale_bar(&mut svg, &sheet);
    Ok(svg.finish())
}

/// Every place that the drawing must hold.
fn corners(plan: &Plan<'_>, background: Option<&OccupancyGrid>) -> Vec<Point2<f64>> {
    let mut places: Vec<_> = plan
        .layers
        .iter()
        .flat_map(|layer| layer.lines.iter().flatten().chain(&layer.points))
        .copied()
        .collect();
    if let Some(map) = background {
        let (width, height) = (map.width() as f64, map.height() as f64);
        for (x, y) in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
            places.push(map.frame().point_from_cells(Point2::new(x, y)));
        }
    }
    places.retain(|place| place.x.is_finite() && place.y.is_finite());
    places
}

/// From metres to pixels.
struct Sheet {
    left: f64,
    top: f64,
    pixels_per_metre: f64,
    width: f64,
    height: f64,
}

impl Sheet {
    fn around(places: Vec<Point2<f64>>) -> anyhow::Result<Self> {
        let bounds =
            places.into_iter().map(|place| (place, place)).reduce(|(low, high), (p, _)| {
                (
                    Point2::new(low.x.min(p.x), low.y.min(p.y)),
                    Point2::new(high.x.max(p.x), high.y.max(p.y)),
                )
            });
        let Some((low, high)) = bounds else {
            anyhow::bail!("a plan needs a wall, a point or a known cell to draw");
        };
        let span = high - low;
        let pixels_per_metre = SIDE / span.x.max(span.y).max(1e-6);
        Ok(Self {
            left: low.x,
            top: high.y,
            pixels_per_metre,
            width: span.x * pixels_per_metre + 2.0 * MARGIN,
            height: span.y * pixels_per_metre + TITLE + 2.0 * MARGIN,
        })
    }

    fn at(&self, place: Point2<f64>) -> [f64; 2] {
        [
            MARGIN + (place.x - self.left) * self.pixels_per_metre,
            TITLE + (self.top - place.y) * self.pixels_per_metre,
        ]
    }
}

fn draw_line(svg: &mut Svg, [from, to]: [[f64; 2]; 2], arrow: bool, colour: &str) {
    if from.iter().chain(&to).any(|coordinate| !coordinate.is_finite()) {
        return;
    }
    svg.line(from, to, colour, 2.0);
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    if arrow && length > 0.0 {
        let (dx, dy) = (dx / length, dy / length);
        for side in [-1.0, 1.0] {
            let back = [to[0] - 8.0 * dx - side * 4.0 * dy, to[1] - 8.0 * dy + side * 4.0 * dx];
            svg.line(to, back, colour, 2.0);
        }
    }
}

/// The image lies in its own pixels; a matrix takes them to the sheet, whatever the map's yaw.
fn draw_map(svg: &mut Svg, sheet: &Sheet, map: &OccupancyGrid) -> anyhow::Result<()> {
    let image = occupancy(map);
    let (columns, rows) = (map.width() as f64, map.height() as f64);
    let corner = |x, y| sheet.at(map.frame().point_from_cells(Point2::new(x, y)));
    let (top_left, top_right) = (corner(0.0, rows), corner(columns, rows));
    let bottom_left = corner(0.0, 0.0);
    let (width, height) = image.dimensions();
    let per_column = |axis: usize| (top_right[axis] - top_left[axis]) / f64::from(width);
    let per_row = |axis: usize| (bottom_left[axis] - top_left[axis]) / f64::from(height);
    svg.push(format_args!(
        "<image width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" opacity=\"0.6\" \
         style=\"image-rendering:pixelated\" transform=\"matrix({:.6} {:.6} {:.6} {:.6} {} {})\" \
         href=\"{}\"/>",
        per_column(0),
        per_column(1),
        per_row(0),
        per_row(1),
        round(top_left[0]),
        round(top_left[1]),
        png_data_uri(&png(&image)?),
    ));
    Ok(())
}

/// A round length of about a fifth of the sheet.
fn draw_scale_bar(svg: &mut Svg, sheet: &Sheet) {
    let fifth = SIDE / 5.0 / sheet.pixels_per_metre;
    let power = 10_f64.powf(fifth.log10().floor());
    let fits = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= fifth * 1.001);
    let metres = fits.unwrap_or(1.0) * power;
    let right = sheet.width.max(240.0) - MARGIN;
    let left = right - metres * sheet.pixels_per_metre;
    let y = sheet.height;
    svg.line([left, y], [right, y], INK, 2.0);
    svg.text([(left + right) / 2.0, y + 16.0], Anchor::Middle, &format!("{metres} m"));
}

#[cfg(test)]
mod tests {
    use super::{Layer, Plan, Sheet, plan};
    use nalgebra::Point2;
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    fn wall(x0: f64, y0: f64, x1: f64, y1: f64) -> Layer {
        Layer {
            name: "walls".into(),
            lines: vec![[Point2::new(x0, y0), Point2::new(x1, y1)]],
            ..Layer::default()
        }
    }

    fn drawn(background: Option<&OccupancyGrid>, layers: Vec<Layer>) -> anyhow::Result<String> {
        plan(&Plan { title: "Walls".into(), background, layers })
    }

    #[test]
    fn metres_keep_their_proportions_and_y_points_up() {
        let places = vec![Point2::new(-1.0, 2.0), Point2::new(3.0, 4.0)];
        let sheet = Sheet::around(places).unwrap();
        let [x0, y0] = sheet.at(Point2::new(0.0, 2.0));
        let [x1, y1] = sheet.at(Point2::new(1.0, 3.0));
        assert!((x1 - x0 - 140.0).abs() < 1e-9 && (y0 - y1 - 140.0).abs() < 1e-9);
    }

    /// The lower left corner of the map is where the wall starts, although the map is turned.
    #[test]
    fn a_turned_background_lies_under_its_walls() {
        let frame = GridFrame::new(1.0, Se2::new(0.0, 0.0, std::f64::consts::FRAC_PI_2)).unwrap();
        let map = OccupancyGrid::from_ascii(frame, "#...\n#...").unwrap();
        let svg = drawn(Some(&map), vec![wall(0.0, 0.0, -2.0, 0.0)]).unwrap();
        let attribute = |name: &str| -> Vec<f64> {
            let text = svg.split(name).nth(1).unwrap().split([')', '"']).next().unwrap();
            text.split(' ').map(|number| number.parse().unwrap()).collect()
        };
        let [a, b, c, d, e, f] = attribute("matrix(")[..] else { panic!("six numbers") };
        let bottom_left = [2.0 * c + e, 2.0 * d + f];
        let (start, end) = (attribute(" x1=\""), attribute(" x2=\""));
        assert!((bottom_left[0] - start[0]).abs() < 0.02, "{bottom_left:?} {start:?}");
        assert!((e - end[0]).abs() < 0.02, "the grid's y axis points to minus x: {e} {end:?}");
        assert!(a.abs() < 1e-6 && b < 0.0, "the grid's x axis points up: {a} {b}");
    }

    #[test]
    fn an_arrow_has_a_head_and_a_dead_line_is_left_out() {
        let arrow = Layer { arrows: true, ..wall(0.0, 0.0, 1.0, 1.0) };
        let plain = drawn(None, vec![wall(0.0, 0.0, 1.0, 1.0)]).unwrap();
        let heads = drawn(None, vec![arrow, wall(0.0, f64::NAN, 1.0, 0.0)]).unwrap();
        assert_eq!(heads.matches("<line").count(), plain.matches("<line").count() + 2);
        assert!(!heads.contains("NaN"));
        assert!(plain.contains(" m</text>"), "a scale bar");
        assert!(drawn(None, Vec::new()).is_err());
    }
}
