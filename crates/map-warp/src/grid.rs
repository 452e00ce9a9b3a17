//! An occupancy grid through a deformation, with all of its walls.

use nalgebra::{Point2, Vector2};
use ogm_core::{
    CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Progress, cell_count,
};

use crate::error::WarpError;
use crate::warp::Warp;

/// Most cells between the places whose origin is computed; between them it is interpolated.
const MOST_COARSE: usize = 32;

/// Cells by which a place interpolated between them errs at most, where the deformation is not steep:
/// the way back is more curved than the displacement, by the cube of one less the slope.
const COARSE_ERROR: f64 = 0.1;

/// A wall that comes out within this many cells of its place is not lost.
const NEAR_CELLS: f64 = 1.0;

/// The map as it lies in the straightened frame of `warp`.
///
/// The lattice of the output is that of `map`, as many cells on as the deformation reaches. Each
/// cell looks up its place in the map (no gaps, thin walls stay thin); an occupied cell of `map`
/// that comes out nowhere, where the deformation shrinks, is put in the cell in which it lies.
///
/// # Errors
/// If the output would be larger than a grid can be, or `progress` says stop.
pub fn warp_grid(
    map: &OccupancyGrid,
    warp: &Warp,
    thresholds: &ClassThresholds,
    progress: &dyn Progress,
) -> Result<OccupancyGrid, WarpError> {
    let (frame, width, height) = extent(map, warp)?;
    let mut cells = Grid::filled(width, height, Occupancy::UNKNOWN)?;
    // Between places h apart a linear interpolation errs by h²/8 of the curvature on each axis.
    let coarse_m = (4.0 * COARSE_ERROR * frame.resolution() / warp.curvature()).sqrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let coarse = (coarse_m / frame.resolution()) as usize;
    let coarse = coarse.clamp(1, MOST_COARSE);
    let mut has_come_out = Grid::filled(map.width(), map.height(), false)?;
    let mut below = origins(map, warp, &frame, width, 0, coarse);
    for first in (0..height).step_by(coarse) {
        progress.go_on(first as f64 / height as f64)?;
        let above = origins(map, warp, &frame, width, first + coarse, coarse);
        for row in first..height.min(first + coarse) {
            let up = (row - first) as f64 / coarse as f64;
            for column in 0..width {
                let (left, right) = (column / coarse, (column % coarse) as f64 / coarse as f64);
                let low = below[left].lerp(&below[left + 1], right);
                let high = above[left].lerp(&above[left + 1], right);
                let Some(origin) = index_of(low.lerp(&high, up)) else { continue };
                let place = cells.get_mut(CellIndex { column, row });
                let source = map.cells().get(origin).zip(has_come_out.get_mut(origin));
                if let (Some(place), Some((&cell, has_come_out))) = (place, source) {
                    *place = cell;
                    *has_come_out = true;
                }
            }
        }
        below = above;
    }
    let lost: Vec<(CellIndex, Occupancy)> = map
        .cells()
        .indexed()
        .filter(|&(index, &cell)| {
            thresholds.is_occupied(cell) && has_come_out.get(index) == Some(&false)
        })
        .filter_map(|(index, &cell)| {
            let place = frame.cells_from_point(warp.apply(map.frame().cell_centre(index)));
            let there = index_of(place.coords)?;
            let near = |right: usize, up: usize| {
                let column = (there.column + right).checked_sub(1)?;
                let at = CellIndex { column, row: (there.row + up).checked_sub(1)? };
                let centre = Vector2::new(at.column as f64 + 0.5, at.row as f64 + 0.5);
                let is_wall = thresholds.is_occupied(*cells.get(at)?);
                (is_wall && (place.coords - centre).norm() <= NEAR_CELLS).then_some(())
            };
            let came_out = (0..9).any(|i| near(i % 3, i / 3).is_some());
            (!came_out).then_some((there, cell))
        })
        .collect();
    for (index, cell) in lost {
        if let Some(output) = cells.get_mut(index) {
            *output = cell;
        }
    }
    Ok(OccupancyGrid::new(frame, cells))
}

/// The output's frame, width and height: what the edge of the map encloses, for a deformation
/// without folds maps the edge to the edge.
fn extent(map: &OccupancyGrid, warp: &Warp) -> Result<(GridFrame, usize, usize), WarpError> {
    let (width, height) = (map.width() as f64, map.height() as f64);
    let along_x = (0..=map.width()).flat_map(|x| [0.0, height].map(|y| (x as f64, y)));
    let along_y = (0..=map.height()).flat_map(|y| [0.0, width].map(|x| (x, y as f64)));
    let (mut from, mut to) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (x, y) in along_x.chain(along_y) {
        let corner = map.frame().point_from_cells(Point2::new(x, y));
        let place = map.frame().cells_from_point(warp.apply(corner));
        for axis in 0..2 {
            from[axis] = from[axis].min((place[axis] - 0.01).floor());
            to[axis] = to[axis].max((place[axis] + 0.01).ceil());
        }
    }
    let [width, height] = [0, 1].map(|axis| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let cells = (to[axis] - from[axis]).max(0.0) as usize;
        cells
    });
    cell_count(width, height)?;
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers")]
    let frame = map.frame().shifted(from[0] as i64, from[1] as i64);
    Ok((frame, width, height))
}

/// Where the centres of every `coarse`th cell of a row of the output come from, in cells of the map.
fn origins(
    map: &OccupancyGrid,
    warp: &Warp,
    frame: &GridFrame,
    width: usize,
    row: usize,
    coarse: usize,
) -> Vec<Vector2<f64>> {
    (0..=width.div_ceil(coarse))
        .map(|step| {
            let place = frame.cell_centre(CellIndex { column: step * coarse, row });
            map.frame().cells_from_point(warp.inverse(place)).coords
        })
        .collect()
}

fn index_of(cells: Vector2<f64>) -> Option<CellIndex> {
    if cells.min() < 0.0 {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let [column, row] = [cells.x as usize, cells.y as usize];
    Some(CellIndex { column, row })
}
