//! Where maps contradict each other, and which of them says what.

use image::{Rgb, RgbImage};
use ogm_core::{CellIndex, Grid, GridError, OccupancyGrid};

use crate::palette::{BLANK, COMMON_WALL, CONFLICT, FREE, UNKNOWN, wall_colour};
use crate::raster::{paint, reduce};

/// What is said of a cell, by the places of the maps that say so.
#[derive(Debug, Clone, Copy)]
pub struct Claimed<'a> {
    /// The maps that say occupied.
    pub occupied: &'a [usize],
    /// Those that say free.
    pub free: &'a [usize],
}

/// The map in light greys with `cells` of it in red; where a pixel holds several cells, red wins,
/// then walls.
///
/// # Errors
/// None that a map could cause; the constructors are asked all the same.
pub fn marked(
    map: &OccupancyGrid,
    cells: impl Iterator<Item = CellIndex>,
) -> Result<RgbImage, GridError> {
    let mut marks = Grid::filled(map.width(), map.height(), 0_u8)?;
    for (mark, cell) in marks.cells_mut().iter_mut().zip(map.cells().cells()) {
        *mark = match cell.probability() {
            None => 0,
            Some(p) if p < 0.5 => 1,
            Some(_) => 2,
        };
    }
    for index in cells {
        if let Some(mark) = marks.get_mut(index) {
            *mark = 3;
        }
    }
    Ok(paint(&reduce(&marks, u8::max), |&mark| match mark {
        0 => UNKNOWN,
        1 => FREE,
        2 => COMMON_WALL,
        _ => CONFLICT,
    }))
}

/// Of each cell, by its place in `claims`, who says what: walls of one map in that map's colour,
/// of several black, contradicted ones in red; free space of one map in a tint of its colour, of
/// several grey; white where nobody says either.
#[must_use]
pub fn provenance(cells: &Grid<u16>, claims: &[Claimed<'_>]) -> RgbImage {
    let shown: Vec<Shown> = claims.iter().map(Shown::of).collect();
    let nothing = Shown { rank: 0, colour: BLANK };
    let shown = cells.map(|&claim| shown.get(usize::from(claim)).copied().unwrap_or(nothing));
    let reduced = reduce(&shown, |a, b| if b.rank > a.rank { b } else { a });
    paint(&reduced, |shown| shown.colour)
}

#[derive(Clone, Copy)]
struct Shown {
    /// The highest of several cells is seen.
    rank: u8,
    colour: Rgb<u8>,
}

impl Shown {
    fn of(claim: &Claimed<'_>) -> Self {
        let of_map = wall_colour;
        let (rank, colour) = match (claim.occupied, claim.free) {
            ([], []) => (0, BLANK),
            ([], [one]) => (1, tint(of_map(*one))),
            ([], _) => (1, UNKNOWN),
            ([one], []) => (2, of_map(*one)),
            (_, []) => (3, COMMON_WALL),
            _ => (4, CONFLICT),
        };
        Self { rank, colour }
    }
}

fn tint(Rgb(colour): Rgb<u8>) -> Rgb<u8> {
    Rgb(colour.map(|part| 255 - (255 - part) / 4))
}

#[cfg(test)]
mod tests {
    use super::{Claimed, marked, provenance};
    use crate::palette::{BLANK, COMMON_WALL, CONFLICT, FREE, UNKNOWN, wall_colour};
    use ogm_core::{CellIndex, Grid, GridFrame, OccupancyGrid, Se2};

    #[test]
    fn marked_cells_are_red_and_the_rest_is_the_map() {
        let frame = GridFrame::new(0.5, Se2::identity()).unwrap();
        let map = OccupancyGrid::from_ascii(frame, "#.?\n..#").unwrap();
        let mark = CellIndex { column: 2, row: 0 };
        let image = marked(&map, [mark].into_iter()).unwrap();
        let row = |y| [0, 1, 2].map(|x| *image.get_pixel(x, y));
        assert_eq!(row(0), [COMMON_WALL, FREE, UNKNOWN]);
        assert_eq!(row(1), [FREE, FREE, CONFLICT]);
    }

    #[test]
    fn a_wall_has_the_colour_of_the_map_that_says_so() {
        let claim = |occupied, free| Claimed { occupied, free };
        let claims = [claim(&[], &[]), claim(&[1], &[]), claim(&[0, 1], &[]), claim(&[0], &[1])];
        let cells = Grid::new(5, 1, vec![0, 1, 2, 3, 7]).unwrap();
        let image = provenance(&cells, &claims);
        let row = [0, 1, 2, 3, 4].map(|x| *image.get_pixel(x, 0));
        assert_eq!(row, [BLANK, wall_colour(1), COMMON_WALL, CONFLICT, BLANK]);
    }
}
