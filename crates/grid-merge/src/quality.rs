//! What a merged map did to its inputs: walls lost, walls grown, free space closed.

use std::ops::Range;

use ogm_core::{ClassThresholds, Grid, OccupancyGrid, l2_distance_sq};

use crate::FusionError;
use crate::mapping::{CellMap, cell_below};
use crate::merge::Merged;
use crate::placed::PlacedMap;
use crate::walls::NEAR_CELLS;

/// What a merged map did to its inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct FusionQuality {
    /// Of each input, in the order that they were merged in.
    pub inputs: Vec<InputQuality>,
    /// Mean thickness of the walls of the merged map, metres.
    pub wall_thickness_m: f64,
    /// Cells that two inputs or more call free, and none anything else.
    pub agreed_free: usize,
    /// How many of them are occupied in the merged map.
    pub closed: usize,
    /// Occupied cells of the merged map.
    pub walls: usize,
    /// Cells reported as conflicts.
    pub conflicts: usize,
}

/// What became of the walls of one input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputQuality {
    /// Its occupied cells.
    pub walls: usize,
    /// Those without an occupied cell of the merged map within 1.5 cells of that one, from centre
    /// to centre.
    pub lost: usize,
    /// Mean thickness of its walls, metres.
    pub wall_thickness_m: f64,
}

impl FusionQuality {
    /// Largest share of an input's wall cells that were lost; 0 where there are none.
    #[must_use]
    pub fn lost(&self) -> f64 {
        self.inputs.iter().map(|input| share(input.lost, input.walls)).fold(0.0, f64::max)
    }

    /// By how many cells of `resolution` metres the walls are thicker than those of the input with
    /// the thickest.
    #[must_use]
    pub fn thicker_cells(&self, resolution: f64) -> f64 {
        let thickest = self.inputs.iter().map(|input| input.wall_thickness_m).fold(0.0, f64::max);
        (self.wall_thickness_m - thickest) / resolution
    }

    /// Share of the cells that the inputs agree to be free which became occupied.
    #[must_use]
    pub fn closed_share(&self) -> f64 {
        share(self.closed, self.agreed_free)
    }

    /// Conflicts over the wall of the merged map.
    #[must_use]
    pub fn conflict_share(&self) -> f64 {
        share(self.conflicts, self.walls)
    }
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}

/// Compares `merged`, of whatever rule, with the `maps` that it was made of.
///
/// Thickness is the shortest run of occupied cells through a cell along the axes and the diagonals
/// of its own lattice, on average over the occupied cells. An input calls a cell of the output free
/// if the cell at its centre is free and no wall of it lands in the cell.
///
/// # Errors
/// None that merged maps could cause; the constructors of grids are asked all the same.
pub fn fusion_quality(
    maps: &[PlacedMap<'_>],
    merged: &Merged,
    thresholds: &ClassThresholds,
) -> Result<FusionQuality, FusionError> {
    let output = &merged.map;
    let walls = output.occupied_mask(thresholds);
    let distance_sq = l2_distance_sq(&walls);
    let mut agreed_free = Grid::filled(output.width(), output.height(), 0_u8)?;
    let mut inputs = Vec::with_capacity(maps.len());
    for placed in maps {
        inputs.push(InputQuality {
            lost: lost(placed, output, distance_sq.as_ref(), thresholds),
            walls: count(placed.map, thresholds),
            wall_thickness_m: wall_thickness(placed.map, thresholds),
        });
        add_opinion(placed, output, thresholds, &mut agreed_free);
    }
    let agreed = agreed_free.cells().iter().zip(walls.cells()).filter(|&(&said, _)| said == AGREED);
    Ok(FusionQuality {
        inputs,
        wall_thickness_m: wall_thickness(output, thresholds),
        agreed_free: agreed.clone().count(),
        closed: agreed.filter(|&(_, &wall)| wall).count(),
        walls: count(output, thresholds),
        conflicts: merged.conflict_count,
    })
}

fn count(map: &OccupancyGrid, thresholds: &ClassThresholds) -> usize {
    map.cells().cells().iter().filter(|&&cell| thresholds.is_occupied(cell)).count()
}

fn lost(
    placed: &PlacedMap<'_>,
    output: &OccupancyGrid,
    distance_sq: Option<&Grid<u32>>,
    thresholds: &ClassThresholds,
) -> usize {
    let points = placed.map.occupied_points(thresholds);
    let Some(distance_sq) = distance_sq else {
        return points.len();
    };
    let is_lost = |point: &nalgebra::Point2<f64>| {
        let point = placed.reference_from_map * *point;
        let Some(at) = output.cell_at(point) else {
            return true;
        };
        // Far from every wall by cells, or near one: only in between is the place in the cell
        // what decides.
        if distance_sq.get(at).is_none_or(|&d| d > 9) {
            return true;
        }
        let near = |at: usize, count: usize| at.saturating_sub(2)..(at + 3).min(count);
        let rows = near(at.row, output.height());
        !rows.into_iter().any(|row| {
            near(at.column, output.width()).any(|column| {
                let index = ogm_core::CellIndex { column, row };
                let centre = output.frame().cell_centre(index);
                distance_sq.get(index) == Some(&0)
                    && (centre - point).norm() <= NEAR_CELLS * output.frame().resolution()
            })
        })
    };
    points.iter().filter(|point| is_lost(point)).count()
}

const UNHEARD: u8 = 0;
const ONCE_FREE: u8 = 1;
const AGREED: u8 = 2;
const OTHERWISE: u8 = 3;

/// What `placed` says of each cell of the output, added to what others said.
fn add_opinion(
    placed: &PlacedMap<'_>,
    output: &OccupancyGrid,
    thresholds: &ClassThresholds,
    said: &mut Grid<u8>,
) {
    let map_from_reference = placed.reference_from_map.inverse();
    let source_cells = CellMap::new(output.frame(), placed.map.frame(), &map_from_reference);
    let width = output.width();
    let (columns, rows) = (placed.map.width(), placed.map.height());
    for (row, said) in said.cells_mut().chunks_exact_mut(width).enumerate() {
        let start = source_cells.at(0.5, row as f64 + 0.5);
        for (column, said) in said.iter_mut().enumerate() {
            let at = start + source_cells.column_step * column as f64;
            let cell = cell_below(at.x, columns).zip(cell_below(at.y, rows));
            let Some((column, row)) = cell else { continue };
            let cell = placed.map.cells().row(row)[column];
            if cell.is_known() {
                *said = match (thresholds.is_free(cell), *said) {
                    (true, UNHEARD) => ONCE_FREE,
                    (true, ONCE_FREE | AGREED) => AGREED,
                    _ => OTHERWISE,
                };
            }
        }
    }
    for point in placed.map.occupied_points(thresholds) {
        let at = output.cell_at(placed.reference_from_map * point);
        if let Some(said) = at.and_then(|at| said.get_mut(at)) {
            *said = OTHERWISE;
        }
    }
}

/// Mean over the occupied cells of the shortest run of such cells through each, metres.
fn wall_thickness(map: &OccupancyGrid, thresholds: &ClassThresholds) -> f64 {
    let walls = map.occupied_mask(thresholds);
    let mut shortest = walls.map(|_| f32::INFINITY);
    let (width, height) = (walls.width().cast_signed(), walls.height().cast_signed());
    for (step, length) in
        [([1, 0], 1.0), ([0, 1], 1.0), ([1, 1], 2.0_f32.sqrt()), ([-1, 1], 2.0_f32.sqrt())]
    {
        shorten_along(&walls, &mut shortest, step, length, [width, height]);
    }
    let runs = shortest.cells().iter().filter(|run| run.is_finite());
    let count = runs.clone().count();
    let sum: f64 = runs.map(|&run| f64::from(run)).sum();
    if count == 0 { 0.0 } else { map.frame().resolution() * sum / count as f64 }
}

/// Lowers every occupied cell to the length of the run through it along a direction.
fn shorten_along(
    walls: &Grid<bool>,
    shortest: &mut Grid<f32>,
    [right, up]: [isize; 2],
    length: f32,
    [width, height]: [isize; 2],
) {
    let inside =
        |column: isize, row: isize| (0..width).contains(&column) && (0..height).contains(&row);
    let is_wall = |column: isize, row: isize| {
        inside(column, row) && walls.cells()[(row * width + column).cast_unsigned()]
    };
    for row in 0..height {
        for column in 0..width {
            // From the first cell of a run only.
            if !is_wall(column, row) || is_wall(column - right, row - up) {
                continue;
            }
            let mut cells: Range<isize> = 0..1;
            while is_wall(column + right * cells.end, row + up * cells.end) {
                cells.end += 1;
            }
            let run = length * cells.end as f32;
            for step in cells {
                let at = ((row + up * step) * width + column + right * step).cast_unsigned();
                let cell = &mut shortest.cells_mut()[at];
                *cell = cell.min(run);
            }
        }
    }
}
