//! Maps drawn on each other.

use image::RgbImage;
use nalgebra::Point2;
use ogm_core::{
    CellIndex, ClassThresholds, Grid, GridFrame, MAX_CELLS, Occupancy, OccupancyGrid, Se2,
    warp_nearest,
};

use crate::ViewError;
use crate::palette::{BLANK, COMMON_WALL, FREE, wall_colour};
use crate::raster::{MAX_SIDE, paint};

/// The most cells that an overlay may cover: as many as a map may have, but not two maps that a
/// wild transform put kilometres apart.
const MAX_OVERLAY_CELLS: i64 = MAX_CELLS as i64;

/// What a pixel shows; walls of map `i` are `FIRST_WALL + i`.
const NOTHING: u16 = 0;
const FREE_SPACE: u16 = 1;
const WALL_OF_SEVERAL: u16 = 2;
const FIRST_WALL: u16 = 3;

/// Both maps in the target's axes, cropped to what either knows: walls of the target blue, of the
/// source orange, of both black; free space pale, the rest white.
///
/// # Errors
/// A transform that is not finite, maps without a known cell, or maps that end up too far apart to
/// be drawn together.
pub fn overlay(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
) -> Result<RgbImage, ViewError> {
    overlay_all(&[(target, Se2::identity()), (source, target_from_source)])
}

/// Any number of maps, each with its pose in the frame of the first, in the axes of the first and
/// cropped to what any knows: walls of one map in the [colour](wall_colour) of its place, of
/// several black; free space pale, the rest white.
///
/// # Errors
/// A pose that is not finite, maps without a known cell, more than 65 000 maps, or maps that end up
/// too far apart to be drawn together.
pub fn overlay_all(maps: &[(&OccupancyGrid, Se2)]) -> Result<RgbImage, ViewError> {
    let Some((first, _)) = maps.first().filter(|_| maps.len() < usize::from(u16::MAX - FIRST_WALL))
    else {
        return Err(ViewError::NothingKnown);
    };
    let lattice = first.frame();
    let mut corners = Vec::new();
    for (map, first_from_map) in maps {
        first_from_map.check_finite()?;
        corners.extend(known_corners(map).into_iter().map(|corner| *first_from_map * corner));
    }
    let cells = corners.into_iter().map(|corner| lattice.lattice_cell(corner));
    let (low, high) = cells
        .map(|cell| (cell, cell))
        .reduce(|(low, high), (cell, _)| {
            (
                [low[0].min(cell[0]), low[1].min(cell[1])],
                [high[0].max(cell[0]), high[1].max(cell[1])],
            )
        })
        .ok_or(ViewError::NothingKnown)?;
    let margin = 2;
    let size =
        [0, 1].map(|axis| high[axis].saturating_sub(low[axis]).saturating_add(1 + 2 * margin));
    let [columns, rows] = size;
    if columns.saturating_mul(rows) > MAX_OVERLAY_CELLS {
        return Err(ViewError::TooManyCells { columns, rows, limit: MAX_OVERLAY_CELLS });
    }
    // Both are positive and their product is checked.
    let cells = |count: i64| usize::try_from(count).unwrap_or(0);
    let (columns, rows) = (cells(columns), cells(rows));
    let factor = columns.max(rows).div_ceil(MAX_SIDE);
    let mut shown = Grid::filled(columns.div_ceil(factor), rows.div_ceil(factor), NOTHING)?;
    let width = shown.width();
    // A strip for each row of pixels, so that a large map is not held twice.
    let first_rows = (0_i64..).step_by(factor);
    for (pixels, first_row) in shown.cells_mut().chunks_exact_mut(width).zip(first_rows) {
        let frame = lattice.shifted(low[0] - margin, low[1] - margin + first_row);
        let size = (columns, factor.min(rows - cells(first_row)));
        for ((map, pose), wall) in maps.iter().zip(FIRST_WALL..) {
            for row in seen_as(map, &frame, size, *pose, wall)?.rows() {
                for (pixel, block) in pixels.iter_mut().zip(row.chunks(factor)) {
                    *pixel = block.iter().fold(*pixel, |seen, &other| both(seen, other));
                }
            }
        }
    }
    Ok(paint(&shown, |&shown| match shown {
        NOTHING => BLANK,
        FREE_SPACE => FREE,
        WALL_OF_SEVERAL => COMMON_WALL,
        wall => wall_colour(usize::from(wall - FIRST_WALL)),
    }))
}

/// What a pixel shows that two things share.
fn both(a: u16, b: u16) -> u16 {
    if a == b || a.min(b) < WALL_OF_SEVERAL { a.max(b) } else { WALL_OF_SEVERAL }
}

/// The map resampled into `frame`: `wall` where it is occupied, [`FREE_SPACE`] where it is free.
fn seen_as(
    map: &OccupancyGrid,
    frame: &GridFrame,
    size: (usize, usize),
    target_from_source: Se2,
    wall: u16,
) -> Result<Grid<u16>, ViewError> {
    let outside = Occupancy::UNKNOWN;
    let motion = &target_from_source;
    let cells = warp_nearest(map.cells(), map.frame(), frame, size, motion, outside)?;
    let thresholds = ClassThresholds::default();
    Ok(cells.map(|&cell| {
        if thresholds.is_occupied(cell) {
            wall
        } else if thresholds.is_free(cell) {
            FREE_SPACE
        } else {
            NOTHING
        }
    }))
}

/// Centres of the cells at the corners of the known part, in the map's frame.
fn known_corners(map: &OccupancyGrid) -> Vec<Point2<f64>> {
    let corners = map.cells().bounds_of(|cell| cell.is_known()).map(|(low, high)| {
        [low.column, high.column]
            .into_iter()
            .flat_map(move |column| [low.row, high.row].map(move |row| CellIndex { column, row }))
    });
    let centres = corners.into_iter().flatten().map(|index| map.frame().cell_centre(index));
    centres.collect()
}

#[cfg(test)]
mod tests {
    use super::{overlay, overlay_all};
    use crate::palette::{BLANK, COMMON_WALL, FREE, SOURCE_WALL, TARGET_WALL, wall_colour};
    use ogm_core::{GridFrame, OccupancyGrid, Se2};

    fn map(picture: &str) -> OccupancyGrid {
        let frame = GridFrame::new(0.5, Se2::new(3.0, -2.0, 0.3)).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap()
    }

    /// The source lies two cells to the right of where it was drawn, in the rotated target frame.
    #[test]
    fn an_overlay_shows_whose_wall_it_is() {
        let target = map("###\n...");
        let shift = target.frame().map_from_grid() * Se2::new(1.0, 0.0, 0.0);
        let target_from_source = shift * target.frame().map_from_grid().inverse();
        let image = overlay(&target, &target, target_from_source).unwrap();
        assert_eq!(image.dimensions(), (9, 6), "five by two and a margin");
        let walls: Vec<_> = (0..9).map(|x| *image.get_pixel(x, 2)).collect();
        let (t, b, s) = (TARGET_WALL, COMMON_WALL, SOURCE_WALL);
        assert_eq!(walls, [BLANK, BLANK, t, t, b, s, s, BLANK, BLANK]);
        assert_eq!(*image.get_pixel(2, 3), FREE);
    }

    #[test]
    fn every_map_of_a_team_has_its_colour() {
        let wall = map("#");
        let apart = |cells: f64| {
            let shift = wall.frame().map_from_grid() * Se2::new(0.5 * cells, 0.0, 0.0);
            shift * wall.frame().map_from_grid().inverse()
        };
        let placed = [0.0, 1.0, 2.0, 2.0, 3.0].map(|cells| (&wall, apart(cells)));
        let image = overlay_all(&placed).unwrap();
        let walls: Vec<_> = (2..6).map(|x| *image.get_pixel(x, 2)).collect();
        assert_eq!(walls, [wall_colour(0), wall_colour(1), COMMON_WALL, wall_colour(4)]);
        assert!(overlay_all(&[]).is_err());
    }

    /// Three cells a pixel: the walls at both ends of 2994 columns keep their pixels.
    #[test]
    fn a_wall_of_one_cell_survives_a_large_map() {
        let picture = format!("#{}#", ".".repeat(2992));
        let target = map(&picture);
        let image = overlay(&target, &map(&".".repeat(2994)), Se2::identity()).unwrap();
        assert_eq!(image.dimensions(), (1000, 2));
        let walls = |y| (0..1000).filter(move |&x| *image.get_pixel(x, y) == TARGET_WALL);
        assert_eq!(walls(1).collect::<Vec<_>>(), [0, 998]);
    }

    #[test]
    fn overlays_that_cannot_be_drawn_are_errors() {
        let (known, unknown) = (map("#"), map("?"));
        assert!(overlay(&known, &known, Se2::new(f64::NAN, 0.0, 0.0)).is_err());
        assert!(overlay(&known, &known, Se2::new(1e8, 1e8, 0.0)).is_err());
        assert!(overlay(&known, &known, Se2::new(1e300, 0.0, 0.0)).is_err());
        assert!(overlay(&unknown, &unknown, Se2::identity()).is_err());
        assert!(overlay(&known, &unknown, Se2::identity()).is_ok());
    }
}
