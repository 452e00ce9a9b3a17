//! From a list of points to the straight lines among them.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};
use ogm_core::{Outcome, ParameterError, Refusal, Segment, require, wrap_period};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::line::Line;
use crate::lines::lines_of;
use crate::params::{InCells, Params};
use crate::strip::Cell;

/// A straight line among points.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PointLine {
    /// Its ends and direction. The reliability is the share of its length on which its members follow
    /// each other within two spacings.
    pub segment: Segment,
    /// Its members, by their place in the list, ascending.
    pub members: Vec<usize>,
}

/// Points are told apart to this share of their spacing.
const FINENESS: f64 = 16.0;

/// Furthest point from the first, in spacings; the products of the votes stay exact.
const MAX_EXTENT: f64 = 1e6;

/// The straight lines among `points`, metres in any frame, that lie about `spacing` metres apart
/// along a wall, such as the end points of a scan.
///
/// All points take part, whatever [`Params::max_points`] says; lengths of `params` that are given
/// in cells count spacings. Refuses without two different points, and when no line is long and
/// reliable enough.
///
/// # Errors
/// A spacing that is not finite and positive, or a point that is not finite or further than a
/// million spacings from the first.
pub fn extract_lines(
    points: &[Point2<f64>],
    spacing: f64,
    params: &Params,
) -> Result<Outcome<Vec<PointLine>>, ParameterError> {
    let is_usable = spacing.is_finite() && spacing > 0.0;
    require(is_usable, "spacing", "finite and above 0 m", spacing)?;
    let unit = spacing / FINENESS;
    let origin = points.first().copied().unwrap_or_default();
    // Points that share a cell stand and fall together.
    let mut members: BTreeMap<Cell, Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        let offset = point - origin;
        // A sum, which NaN survives.
        let extent = (offset.x.abs() + offset.y.abs()) / spacing;
        require(extent <= MAX_EXTENT, "points", "finite, within 1e6 spacings", extent)?;
        members.entry(nearest(offset / unit)).or_default().push(index);
    }
    let have = members.len();
    if have < 2 {
        return Ok(Outcome::Refused(Refusal::TooLittleStructure { have, need: 2 }));
    }
    let limits = InCells::new(params, spacing).finer(FINENESS);
    let mut rng = ChaCha8Rng::seed_from_u64(params.seed);
    let joined = lines_of(members.keys().copied().collect(), &limits, params, &mut rng).joined;
    let candidates = joined.len();
    let lines: Vec<PointLine> = joined
        .iter()
        .filter(|line| line.length() > limits.min_length)
        .map(|line| {
            let mut of_line: Vec<usize> =
                line.cells.iter().filter_map(|cell| members.get(cell)).flatten().copied().collect();
            of_line.sort_unstable();
            let [start, end] = line.ends(params.direction).map(|end| origin + unit * end.coords);
            let segment = Segment {
                start,
                end,
                direction: wrap_period(line.direction, PI),
                reliability: coverage(line, params),
                support: of_line.len(),
            };
            PointLine { segment, members: of_line }
        })
        .filter(|line| line.segment.reliability >= params.min_reliability)
        .collect();
    if lines.is_empty() {
        return Ok(Outcome::Refused(Refusal::NoLines { candidates }));
    }
    Ok(Outcome::Found(lines))
}

/// Share of a line's length on which its cells follow each other within two spacings.
fn coverage(line: &Line, params: &Params) -> f64 {
    let [start, end] = line.ends(params.direction);
    let axis = end - start;
    let length = axis.norm();
    let mut along: Vec<f64> = line
        .cells
        .iter()
        .map(|&[x, y]| axis.dot(&(Point2::new(f64::from(x), f64::from(y)) - start)) / length)
        .collect();
    along.sort_by(f64::total_cmp);
    let steps = along.windows(2).map(|pair| (pair[1] - pair[0]).min(2.0 * FINENESS));
    (steps.sum::<f64>() / length).min(1.0)
}

#[expect(clippy::cast_possible_truncation, reason = "bounded by the extent")]
fn nearest(cells: Vector2<f64>) -> Cell {
    [cells.x.round() as i32, cells.y.round() as i32]
}
