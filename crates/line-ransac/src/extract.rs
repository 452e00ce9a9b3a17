//! From a map to its walls.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};
use ogm_core::{
    CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Outcome, Refusal,
    Segment, wrap_period,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::line::Line;
use crate::lines::lines_of;
use crate::params::{InCells, Params};
use crate::reliability::reliability;
use crate::strip::Cell;

/// The straight walls of a map, and how they came about.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Extraction {
    /// Walls that are long and reliable enough; at least one.
    pub segments: Vec<Segment>,
    /// The sampled cells that support each of them.
    pub members: Vec<Vec<CellIndex>>,
    /// Lines before the last filter.
    pub stages: Stages,
    /// What it took.
    pub statistics: Statistics,
}

/// End points of the lines after each stage, metres in the map frame.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Stages {
    /// As voted for (Tsardoulias et al., Figure 7).
    pub detected: Vec<[Point2<f64>; 2]>,
    /// After breaking at gaps (Figure 8).
    pub broken: Vec<[Point2<f64>; 2]>,
    /// After joining (Figure 10).
    pub joined: Vec<[Point2<f64>; 2]>,
}

/// Counts of one extraction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Statistics {
    /// Occupied cells of the map.
    pub occupied: usize,
    /// Those that took part.
    pub sampled: usize,
    /// Pairs of cells that were drawn.
    pub trials: usize,
    /// Detected lines that were the best of all trials without reaching [`Params::accept_share`].
    pub fallback_lines: usize,
}

/// The straight walls of `map` (Tsardoulias et al., section 4.1.1).
///
/// Segments are in the map frame; their support counts sampled cells. Refused without two occupied
/// cells, and when no line is long and reliable enough.
pub fn extract_segments(map: &OccupancyGrid, params: &Params) -> Outcome<Extraction> {
    let occupied_cells = occupied_cells(map.cells(), &params.classes);
    let occupied = occupied_cells.len();
    if occupied < 2 {
        return Outcome::Refused(Refusal::TooLittleStructure { have: occupied, need: 2 });
    }
    let limits = InCells::new(params, map.frame().resolution());
    let mut rng = ChaCha8Rng::seed_from_u64(params.seed);
    let sample = sample(occupied_cells, params.max_points, &mut rng);
    let sampled = sample.len();
    let found = lines_of(sample, &limits, params, &mut rng);
    let (members, segments): (Vec<_>, Vec<_>) = found
        .joined
        .iter()
        .filter(|line| line.length() > limits.min_length)
        .map(|line| {
            (line.cells.iter().map(|&cell| index(cell)).collect(), to_segment(line, map, params))
        })
        .filter(|(_, segment): &(_, Segment)| segment.reliability >= params.min_reliability)
        .unzip();
    if segments.is_empty() {
        return Outcome::Refused(Refusal::NoLines { candidates: found.joined.len() });
    }
    let ends = |lines: &[Line]| {
        let ends = lines.iter().map(|line| line.limits.map(|cell| centre(cell, map.frame())));
        ends.collect()
    };
    Outcome::Found(Extraction {
        segments,
        members,
        statistics: Statistics {
            occupied,
            sampled,
            trials: found.detection.trials,
            fallback_lines: found.detection.fallback_lines,
        },
        stages: Stages {
            detected: ends(&found.detection.lines),
            broken: ends(&found.broken),
            joined: ends(&found.joined),
        },
    })
}

/// Occupied cells, row-major.
fn occupied_cells(grid: &Grid<Occupancy>, classes: &ClassThresholds) -> Vec<Cell> {
    /// Cells that are skipped at once when none is occupied.
    const RUN: usize = 32;
    let mut occupied = Vec::new();
    for (row, cells) in (0..).zip(grid.rows()) {
        for (from, run) in (0..).step_by(RUN).zip(cells.chunks(RUN)) {
            let any = run.iter().fold(false, |any, &cell| any | classes.is_occupied(cell));
            if any {
                let columns = (from..).zip(run);
                let columns = columns.filter(|&(_, &cell)| classes.is_occupied(cell));
                occupied.extend(columns.map(|(column, _)| [column, row]));
            }
        }
    }
    occupied
}

/// At most `size` of `cells`, drawn without replacement.
fn sample(mut cells: Vec<Cell>, size: usize, rng: &mut ChaCha8Rng) -> Vec<Cell> {
    if cells.len() > size {
        for place in 0..size {
            let drawn = rng.random_range(place..cells.len());
            cells.swap(place, drawn);
        }
        cells.truncate(size);
    }
    cells
}

fn to_segment(line: &Line, map: &OccupancyGrid, params: &Params) -> Segment {
    let ends = line.ends(params.direction);
    let half = Vector2::repeat(0.5);
    let [start, end] = ends.map(|end| map.frame().point_from_cells(end + half));
    let yaw = map.frame().map_from_grid().theta();
    Segment {
        start,
        end,
        direction: wrap_period(line.direction + yaw, PI),
        reliability: reliability(map.cells(), ends.map(nearest), params.reliability_band),
        support: line.cells.len(),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "between cells, which fit")]
fn nearest(place: Point2<f64>) -> Cell {
    [place.x.round() as i32, place.y.round() as i32]
}

#[expect(clippy::cast_sign_loss, reason = "cells of a grid count from 0")]
fn index([column, row]: Cell) -> CellIndex {
    CellIndex { column: column as usize, row: row as usize }
}

fn centre([column, row]: Cell, frame: &GridFrame) -> Point2<f64> {
    frame.point_from_cells(Point2::new(f64::from(column) + 0.5, f64::from(row) + 0.5))
}
