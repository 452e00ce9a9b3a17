//! Wall segments of one length, traced along the smoothed edges.

use nalgebra::{Point2, Vector2};
use ogm_core::{CellIndex, Grid, GridFrame, ParameterError, require};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::RadonError;
use crate::{DistinctiveParams, Signature, is_distinctive, signature};

/// How segments are traced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentParams {
    /// Points after the first, a cell apart: n of the paper, which prints none. 60 cells hold a
    /// corner or two of a building.
    pub points: usize,
    /// Furthest cell that a segment goes on at, cells: bridges what noise tears apart.
    pub reach: usize,
    /// Most distinctive segments of a map; more are drawn by lot.
    pub max_segments: usize,
}

impl Default for SegmentParams {
    fn default() -> Self {
        Self { points: 60, reach: 3, max_segments: 1000 }
    }
}

impl SegmentParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let points = self.points as f64;
        require((3..=10_000).contains(&self.points), "segments.points", "3 to 10 000", points)?;
        let reach = self.reach as f64;
        require((1..=20).contains(&self.reach), "segments.reach", "1 to 20 cells", reach)
    }
}

/// A traced segment and its signature.
#[derive(Debug, Clone, PartialEq)]
pub struct WallSegment {
    /// P(0), …, P(n), map frame, metres.
    pub points: Vec<Point2<f64>>,
    /// What stays of it under rotation and translation.
    pub signature: Signature,
}

/// Distinctive segments of a map, from every edge cell in both directions, in an order drawn by
/// `seed`, at most [`SegmentParams::max_segments`] (Saeedi et al., sections II.D and II.E).
///
/// # Errors
/// A parameter out of range.
pub fn distinctive_segments(
    edges: &Grid<bool>,
    frame: &GridFrame,
    seed: u64,
    params: &SegmentParams,
    distinctive: &DistinctiveParams,
) -> Result<Vec<WallSegment>, RadonError> {
    params.check()?;
    distinctive.check()?;
    let cells = edges.indexed().filter(|(_, edge)| **edge);
    let mut starts: Vec<(CellIndex, bool)> =
        cells.flat_map(|(index, _)| [(index, false), (index, true)]).collect();
    starts.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
    let length = params.points as f64 * frame.resolution();
    let mut tracer = Tracer::new(edges, params);
    let segments = starts.into_iter().filter_map(|(start, reversed)| {
        let path = tracer.trace(start, reversed)?;
        let points: Vec<_> = path.into_iter().map(|cells| frame.point_from_cells(cells)).collect();
        let signature = signature(&points)?;
        is_distinctive(&signature, length, distinctive).then_some(WallSegment { points, signature })
    });
    Ok(segments.take(params.max_segments).collect())
}

/// Follows edges from cell to cell.
struct Tracer<'a> {
    edges: &'a Grid<bool>,
    params: &'a SegmentParams,
    /// The trace that last came by, so that nothing need be cleared between traces.
    visited: Grid<u32>,
    trace: u32,
}

/// Share of the old heading in the new one: bridges the staircase of a slanted wall.
const INERTIA: f64 = 0.7;

/// Cosine of the sharpest turn that a segment may take at a cell: a little over a right angle.
const SHARPEST_TURN: f64 = -0.2;

impl<'a> Tracer<'a> {
    fn new(edges: &'a Grid<bool>, params: &'a SegmentParams) -> Self {
        Self { edges, params, visited: edges.map(|_| 0), trace: 0 }
    }

    /// Points a cell apart along the edge from `start`, in cells; `None` if it ends too early.
    fn trace(&mut self, start: CellIndex, reversed: bool) -> Option<Vec<Point2<f64>>> {
        self.trace += 1;
        let along = self.direction_at(start)?;
        let mut heading = if reversed { -along } else { along };
        let mut path = vec![start];
        // Smoothing shortens the path at its corners.
        let need = self.params.points as f64 * 1.1 + 3.0;
        let mut length = 0.0;
        while length < need {
            let here = path[path.len() - 1];
            let (next, step) = self.next(here, heading)?;
            self.mark_around(here);
            length += step.norm();
            heading = (heading * INERTIA + step.normalize() * (1.0 - INERTIA)).normalize();
            path.push(next);
        }
        resample(&smooth(&path), self.params.points)
    }

    /// The unvisited edge cell that deviates least from `heading`: a neighbour, or else one within
    /// reach.
    fn next(&self, from: CellIndex, heading: Vector2<f64>) -> Option<(CellIndex, Vector2<f64>)> {
        [1, self.params.reach].into_iter().find_map(|reach| {
            let mut best: Option<(f64, CellIndex, Vector2<f64>)> = None;
            for (cell, step) in around(self.edges, from, reach) {
                let edge = self.edges.get(cell).is_some_and(|edge| *edge);
                if !edge || self.visited.get(cell) == Some(&self.trace) || step.norm() == 0.0 {
                    continue;
                }
                let cosine = step.dot(&heading) / step.norm();
                if cosine > SHARPEST_TURN && best.is_none_or(|(most, ..)| cosine > most) {
                    best = Some((cosine, cell, step));
                }
            }
            best.map(|(_, cell, step)| (cell, step))
        })
    }

    /// Nothing near a cell that was left is gone to later.
    fn mark_around(&mut self, cell: CellIndex) {
        for (near, _) in around(self.edges, cell, 1) {
            if let Some(visited) = self.visited.get_mut(near) {
                *visited = self.trace;
            }
        }
    }

    /// Unit vector along the edge cells around `cell`.
    fn direction_at(&self, cell: CellIndex) -> Option<Vector2<f64>> {
        let (mut difference, mut product) = (0.0, 0.0);
        for (near, step) in around(self.edges, cell, self.params.reach) {
            if self.edges.get(near).is_some_and(|edge| *edge) {
                difference += step.x * step.x - step.y * step.y;
                product += 2.0 * step.x * step.y;
            }
        }
        let angle = 0.5 * f64::atan2(product, difference);
        (product != 0.0 || difference != 0.0).then(|| Vector2::new(angle.cos(), angle.sin()))
    }
}

/// Cells at most `reach` columns and rows from `centre`, and the steps to them.
fn around(
    grid: &Grid<bool>,
    centre: CellIndex,
    reach: usize,
) -> impl Iterator<Item = (CellIndex, Vector2<f64>)> + use<> {
    let columns =
        centre.column.saturating_sub(reach)..(centre.column + reach + 1).min(grid.width());
    let rows = centre.row.saturating_sub(reach)..(centre.row + reach + 1).min(grid.height());
    rows.flat_map(move |row| {
        columns.clone().map(move |column| {
            let dx = column as f64 - centre.column as f64;
            let dy = row as f64 - centre.row as f64;
            (CellIndex { column, row }, Vector2::new(dx, dy))
        })
    })
}

/// Centres of the cells, each averaged with the two before and after it.
fn smooth(path: &[CellIndex]) -> Vec<Point2<f64>> {
    let centre = |cell: &CellIndex| Vector2::new(cell.column as f64 + 0.5, cell.row as f64 + 0.5);
    let means = (0..path.len()).map(|index| {
        let reach = index.min(path.len() - 1 - index).min(2);
        let near = &path[index - reach..=index + reach];
        let sum = near.iter().fold(Vector2::zeros(), |sum, cell| sum + centre(cell));
        Point2::from(sum / near.len() as f64)
    });
    means.collect()
}

/// The first `count` + 1 points at distances of one along `path`; `None` if it is too short.
fn resample(path: &[Point2<f64>], count: usize) -> Option<Vec<Point2<f64>>> {
    let mut points = Vec::with_capacity(count + 1);
    points.push(*path.first()?);
    let mut beyond = 1.0;
    for pair in path.windows(2) {
        let step = pair[1] - pair[0];
        let length = step.norm();
        while beyond <= length {
            points.push(pair[0] + step * (beyond / length));
            if points.len() > count {
                return Some(points);
            }
            beyond += 1.0;
        }
        beyond -= length;
    }
    None
}
