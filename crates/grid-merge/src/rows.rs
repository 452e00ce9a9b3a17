//! Rows of a map on the lattice of the output, made when they are asked for.

use std::borrow::Cow;
use std::ops::Range;

use nalgebra::{Point2, Vector2};
use ogm_core::{ClassThresholds, Grid, GridError, GridFrame, NearestWarp, Occupancy, Se2};

use crate::evidence::{ByteOfLogOdds, LogOddsOfByte, MeanLogOdds};
use crate::mapping::{CellMap, cell_below};

/// Rows of sums that exist at a time while a finer map is gathered.
const GATHERED_ROWS: usize = 32;

/// The rectangle of the output that a map reaches, and what it says there.
pub(crate) struct Reach<'a> {
    pub(crate) columns: Range<usize>,
    pub(crate) rows: Range<usize>,
    pub(crate) cells: ReachCells<'a>,
}

/// Cells of the output, from the first of a [`Reach`] on.
pub(crate) enum ReachCells<'a> {
    /// They are there already.
    Laid(Cow<'a, Grid<Occupancy>>),
    /// They are looked up in the map.
    Warped(Box<WarpedMap<'a>>),
}

/// A map that is looked up, and where on the output.
pub(crate) struct WarpedReach<'a> {
    first_column: usize,
    rows: Range<usize>,
    map: &'a WarpedMap<'a>,
}

/// What a map says in some rows of the output; unknown outside.
#[derive(Default)]
pub(crate) struct Said {
    pub(crate) columns: Range<usize>,
    pub(crate) rows: Range<usize>,
    cells: Vec<Occupancy>,
}

impl Reach<'_> {
    /// The map itself, where its cells are not those of the output.
    pub(crate) fn warped(&self) -> Option<WarpedReach<'_>> {
        match &self.cells {
            ReachCells::Laid(_) => None,
            ReachCells::Warped(map) => {
                Some(WarpedReach { first_column: self.columns.start, rows: self.rows.clone(), map })
            }
        }
    }

    /// Makes `said` what the map says in `rows` of the output.
    pub(crate) fn read(&self, rows: &Range<usize>, said: &mut Said) {
        let from = rows.start.max(self.rows.start);
        said.rows = from..rows.end.min(self.rows.end).max(from);
        said.columns = self.columns.clone();
        let width = self.columns.len();
        said.cells.clear();
        said.cells.resize(said.rows.len() * width, Occupancy::UNKNOWN);
        if said.rows.is_empty() {
            return;
        }
        let first_row = from - self.rows.start;
        match &self.cells {
            ReachCells::Laid(cells) => {
                let laid = &cells.cells()[first_row * width..];
                said.cells.copy_from_slice(&laid[..said.rows.len() * width]);
            }
            ReachCells::Warped(map) if map.is_finer => {
                map.gather(first_row, width, &mut said.cells)
            }
            ReachCells::Warped(map) => map.look_up(first_row, width, &mut said.cells),
        }
    }
}

impl WarpedReach<'_> {
    /// Every wall cell of the map whose centre lands in `rows` of the output: what it says, and
    /// where it lands, in cells of the output.
    pub(crate) fn for_each_wall(
        &self,
        rows: &Range<usize>,
        mut landed: impl FnMut(Occupancy, Point2<f64>),
    ) {
        let first = rows.start.max(self.rows.start);
        let last = rows.end.min(self.rows.end).max(first);
        let corner = Vector2::new(self.first_column as f64, first as f64);
        self.map.for_each_landing(first - self.rows.start, last - first, |cell, place| {
            if self.map.thresholds.is_occupied(cell) {
                landed(cell, place + corner);
            }
        });
    }
}

impl Said {
    /// Its cells in a row of the output, from the first of its columns; empty where it has none.
    pub(crate) fn row(&self, row: usize) -> &[Occupancy] {
        if !self.rows.contains(&row) {
            return &[];
        }
        let width = self.columns.len();
        &self.cells[(row - self.rows.start) * width..][..width]
    }

    /// Lets the map say `cell` in one of its cells.
    pub(crate) fn set(&mut self, row: usize, column: usize, cell: Occupancy) {
        if self.rows.contains(&row) && self.columns.contains(&column) {
            let at = (row - self.rows.start) * self.columns.len() + column - self.columns.start;
            self.cells[at] = cell;
        }
    }

    pub(crate) fn at(&self, row: usize, column: usize) -> Occupancy {
        let cells = self.row(row);
        let column = column.checked_sub(self.columns.start);
        column.and_then(|column| cells.get(column)).copied().unwrap_or(Occupancy::UNKNOWN)
    }
}

/// A map that is looked up by nearest cell; of the cells of a finer map that share an output cell
/// the walls count.
pub(crate) struct WarpedMap<'a> {
    source: &'a Grid<Occupancy>,
    thresholds: ClassThresholds,
    nearest: NearestWarp,
    output_from_source: CellMap,
    is_finer: bool,
    log_odds: LogOddsOfByte,
    rounding: ByteOfLogOdds,
}

impl<'a> WarpedMap<'a> {
    /// `source` on the output whose cell (0, 0) is that of `output_frame`.
    pub(crate) fn new(
        source: &'a Grid<Occupancy>,
        source_frame: &GridFrame,
        output_frame: &GridFrame,
        reference_from_map: &Se2,
        thresholds: ClassThresholds,
    ) -> Result<Self, GridError> {
        let is_finer = source_frame.resolution() < output_frame.resolution();
        Ok(Self {
            source,
            thresholds,
            nearest: NearestWarp::new(source_frame, output_frame, reference_from_map)?,
            output_from_source: CellMap::new(source_frame, output_frame, reference_from_map),
            is_finer: is_finer && !source_frame.same_resolution(output_frame),
            log_odds: LogOddsOfByte::new(),
            rounding: ByteOfLogOdds::new(),
        })
    }

    fn look_up(&self, first_row: usize, width: usize, output: &mut [Occupancy]) {
        for (row, output) in output.chunks_exact_mut(width).enumerate() {
            self.nearest.fill_row(self.source, first_row + row, output);
        }
    }

    /// Every cell of the source whose centre lands in the rows, and where, in cells from the first
    /// of them.
    fn for_each_landing(
        &self,
        first_row: usize,
        rows: usize,
        mut landed: impl FnMut(Occupancy, Point2<f64>),
    ) {
        let steps = &self.output_from_source;
        let below = Vector2::new(0.0, first_row as f64);
        let limits = [below.y, below.y + rows as f64];
        for (source_row, cells) in self.source.rows().enumerate() {
            let start = steps.at(0.5, source_row as f64 + 0.5);
            let columns = columns_between(start.y, steps.column_step.y, limits, cells.len());
            for column in columns {
                let place = start + steps.column_step * column as f64 - below;
                landed(cells[column], place);
            }
        }
    }

    /// As [`coarsen`](crate::coarsen()), on the lattice of the output; cells on which no centre
    /// lands are looked up.
    fn gather(&self, first_row: usize, width: usize, output: &mut [Occupancy]) {
        self.look_up(first_row, width, output);
        let mut means = vec![MeanLogOdds::default(); GATHERED_ROWS * width];
        for (part, output) in output.chunks_mut(GATHERED_ROWS * width).enumerate() {
            means.fill(MeanLogOdds::default());
            let first_row = first_row + part * GATHERED_ROWS;
            let rows = output.len() / width;
            self.for_each_landing(first_row, rows, |cell, place| {
                let at = cell_below(place.x, width).zip(cell_below(place.y, rows));
                if let Some((column, row)) = at.filter(|_| cell.is_known()) {
                    let is_wall = self.thresholds.is_occupied(cell);
                    means[row * width + column].add(self.log_odds.of(cell), is_wall);
                }
            });
            for (cell, sum) in output.iter_mut().zip(&means) {
                if let Some(mean) = sum.mean() {
                    *cell = self.rounding.round(mean);
                }
            }
        }
    }
}

/// The columns whose value `start + step · column` can lie between two limits.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the columns before the cast"
)]
fn columns_between(start: f64, step: f64, [low, high]: [f64; 2], columns: usize) -> Range<usize> {
    let count = columns as f64;
    let [from, to] = if step.abs() < 1e-12 {
        if start < low - 1.0 || start > high + 1.0 { [0.0; 2] } else { [0.0, count] }
    } else {
        let (a, b) = ((low - start) / step, (high - start) / step);
        [a.min(b).floor() - 1.0, a.max(b).ceil() + 2.0].map(|column| column.clamp(0.0, count))
    };
    from as usize..(to as usize).max(from as usize)
}
