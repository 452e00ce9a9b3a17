//! Maps as pixels.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageEncoder, Rgb, RgbImage};
use ogm_core::{CellIndex, Grid, OccupancyGrid};

use crate::ViewError;
use crate::palette::{BLANK, UNKNOWN};

/// Pictures of more cells a side show several cells a pixel.
pub(crate) const MAX_SIDE: usize = 1000;

/// The map in greys: free light, occupied dark, unknown in the middle. Where a pixel holds several
/// cells it shows the most occupied, so that thin walls stay.
#[must_use]
pub fn occupancy(map: &OccupancyGrid) -> RgbImage {
    let cells = reduce(map.cells(), |a, b| match (a.is_known(), b.is_known()) {
        (true, true) => a.max(b),
        (true, false) => a,
        _ => b,
    });
    paint(&cells, |cell| match cell.probability() {
        Some(p) => Rgb([grey(p); 3]),
        None => UNKNOWN,
    })
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "p is in [0, 1]")]
fn grey(p: f64) -> u8 {
    (255.0 - 255.0 * p).round() as u8
}

/// Unknown cells that a crop leaves around the known ones.
const MARGIN: usize = 2;

/// The map without the margins that nobody has seen, all but two cells; a map without a known cell
/// stays whole.
///
/// # Errors
/// None that a map could cause; the constructors are asked all the same.
pub fn crop_known(map: &OccupancyGrid) -> Result<OccupancyGrid, ViewError> {
    let Some((low, high)) = map.cells().bounds_of(|cell| cell.is_known()) else {
        return Ok(map.clone());
    };
    let first = [low.column.saturating_sub(MARGIN), low.row.saturating_sub(MARGIN)];
    let end =
        [(high.column + MARGIN + 1).min(map.width()), (high.row + MARGIN + 1).min(map.height())];
    let rows = map.cells().rows().skip(first[1]).take(end[1] - first[1]);
    let cells = rows.flat_map(|row| &row[first[0]..end[0]]).copied().collect();
    let grid = Grid::new(end[0] - first[0], end[1] - first[1], cells)?;
    // A grid has fewer than 2³² columns and rows.
    let cells = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
    let frame = map.frame().shifted(cells(first[0]), cells(first[1]));
    Ok(OccupancyGrid::new(frame, grid))
}

/// Square blocks of cells as one cell, so that no side exceeds 1000 cells.
///
/// # Panics
/// Never: every block holds at least its corner cell.
#[must_use]
pub fn reduce<T: Copy>(grid: &Grid<T>, merge: impl Fn(T, T) -> T) -> Grid<T> {
    let factor = grid.width().max(grid.height()).div_ceil(MAX_SIDE);
    let (width, height) = (grid.width().div_ceil(factor), grid.height().div_ceil(factor));
    let corner = |position: usize| CellIndex {
        column: position % width * factor,
        row: position / width * factor,
    };
    let block = |first: CellIndex| {
        let rows = first.row..(first.row + factor).min(grid.height());
        let columns = first.column..(first.column + factor).min(grid.width());
        rows.flat_map(move |row| grid.row(row)[columns.clone()].iter().copied()).reduce(&merge)
    };
    let cells = (0..width * height).filter_map(|position| block(corner(position))).collect();
    Grid::new(width, height, cells).expect("every block holds its corner cell")
}

/// One pixel a cell, the highest row at the top.
///
/// # Panics
/// Never: a grid has fewer than 2³² columns and rows.
#[must_use]
pub fn paint<T>(grid: &Grid<T>, colour: impl Fn(&T) -> Rgb<u8>) -> RgbImage {
    let size = |cells: usize| u32::try_from(cells).expect("a grid has fewer than 2³² rows");
    let mut image = RgbImage::new(size(grid.width()), size(grid.height()));
    let cells = grid.rows().rev().flatten();
    for (pixel, cell) in image.pixels_mut().zip(cells) {
        *pixel = colour(cell);
    }
    image
}

/// Each pixel as a square of `factor` pixels.
#[must_use]
pub fn enlarge(image: &RgbImage, factor: u32) -> RgbImage {
    let factor = factor.max(1);
    RgbImage::from_fn(image.width() * factor, image.height() * factor, |x, y| {
        *image.get_pixel(x / factor, y / factor)
    })
}

/// Pictures in a row on white, `gap` pixels apart, scaled down if they exceed 1000 pixels in
/// width together.
#[must_use]
pub fn side_by_side(images: &[RgbImage], gap: u32) -> RgbImage {
    let gaps = gap * u32::try_from(images.len().saturating_sub(1)).unwrap_or(0);
    let width = images.iter().map(RgbImage::width).sum::<u32>() + gaps;
    let height = images.iter().map(RgbImage::height).max().unwrap_or(0);
    let mut row = RgbImage::from_pixel(width.max(1), height.max(1), BLANK);
    let mut left = 0;
    for image in images {
        image::imageops::replace(&mut row, image, i64::from(left), 0);
        left += image.width() + gap;
    }
    let limit = u32::try_from(MAX_SIDE).unwrap_or(u32::MAX);
    if row.width() <= limit {
        return row;
    }
    let height = (u64::from(row.height()) * u64::from(limit)).div_ceil(u64::from(row.width()));
    image::imageops::thumbnail(&row, limit, u32::try_from(height).unwrap_or(limit))
}

/// The picture as a PNG file.
///
/// # Errors
/// A picture without area.
pub fn png(image: &RgbImage) -> Result<Vec<u8>, ViewError> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::NoFilter)
        .write_image(image, image.width(), image.height(), image::ExtendedColorType::Rgb8)
        .map_err(|error| ViewError::Png {
            width: image.width(),
            height: image.height(),
            message: error.to_string(),
        })?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::{crop_known, enlarge, occupancy, png, side_by_side};
    use crate::palette::{BLANK, COMMON_WALL, UNKNOWN};
    use image::RgbImage;
    use ogm_core::{CellIndex, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};

    fn map(picture: &str) -> OccupancyGrid {
        let frame = GridFrame::new(0.5, Se2::new(3.0, -2.0, 0.3)).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap()
    }

    #[test]
    fn the_highest_row_is_at_the_top_and_walls_are_dark() {
        let image = occupancy(&map("#.\n?."));
        assert!(image.get_pixel(0, 0).0[0] < 60, "a wall");
        assert!(image.get_pixel(1, 0).0[0] > 200, "free space");
        assert_eq!(*image.get_pixel(0, 1), UNKNOWN);
    }

    #[test]
    fn a_thin_wall_survives_a_large_map() {
        let mut big = Grid::filled(2500, 4, Occupancy::FREE).unwrap();
        *big.get_mut(CellIndex { column: 1201, row: 2 }).unwrap() = Occupancy::OCCUPIED;
        let image = occupancy(&OccupancyGrid::new(*map(".").frame(), big));
        assert_eq!(image.dimensions(), (834, 2));
        assert!(image.get_pixel(400, 1).0[0] < 60);
    }

    #[test]
    fn cropping_moves_no_cell() {
        let whole = map("???????\n????.#?\n???????\n???????\n???????");
        let part = crop_known(&whole).unwrap();
        assert_eq!((part.width(), part.height()), (5, 4));
        for (column, expected) in [(1, '?'), (2, '.'), (3, '#'), (4, '?')] {
            let place = part.frame().cell_centre(CellIndex { column, row: 2 });
            assert_eq!(whole.cell_at(place).map(|cell| cell.column), Some(column + 2));
            assert_eq!(part.to_ascii().lines().nth(1).unwrap().chars().nth(column), Some(expected));
        }
        let unknown = map("???\n???");
        assert_eq!(crop_known(&unknown).unwrap(), unknown);
    }

    #[test]
    fn panels_keep_their_pixels_until_they_are_too_wide() {
        let tile = RgbImage::from_pixel(3, 2, COMMON_WALL);
        let row = side_by_side(&[tile.clone(), enlarge(&tile, 2)], 1);
        assert_eq!(row.dimensions(), (10, 4));
        assert_eq!((*row.get_pixel(2, 1), *row.get_pixel(3, 1)), (COMMON_WALL, BLANK));
        assert_eq!((*row.get_pixel(0, 3), *row.get_pixel(9, 3)), (BLANK, COMMON_WALL));
        let wide = side_by_side(&[enlarge(&tile, 300), enlarge(&tile, 300)], 0);
        assert_eq!(wide.dimensions(), (1000, 334));
    }

    #[test]
    fn a_png_reads_back() {
        let image = occupancy(&map("#.?\n.#."));
        let read = image::load_from_memory(&png(&image).unwrap()).unwrap();
        assert_eq!(read.to_rgb8(), image);
    }
}
