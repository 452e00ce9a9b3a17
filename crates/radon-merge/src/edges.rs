//! Edges of the occupied cells (Canny).

use imageproc::edges::canny;
use imageproc::image::{GrayImage, Luma};
use ogm_core::{ClassThresholds, Grid, GridError, OccupancyGrid, ParameterError, require};

use crate::RadonError;

/// How edges are detected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeParams {
    /// Gradient below which an edge ends, as a share of the steepest that the detector's smoothing
    /// lets through; the paper prints none.
    pub low: f64,
    /// Gradient at which an edge begins, as the same share; at least `low`.
    pub high: f64,
}

impl Default for EdgeParams {
    fn default() -> Self {
        Self { low: 0.1, high: 0.3 }
    }
}

impl EdgeParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let in_order = self.low > 0.0 && self.low <= self.high && self.high <= 1.0;
        require(in_order, "edges.low", "above 0, at most `high`, which is at most 1", self.low)
    }
}

/// Sobel response to a straight black-to-white edge after the detector's Gaussian of 1.4 cells:
/// 8 × 255 × the middle of the Gaussian.
const STEEPEST: f64 = 8.0 * 255.0 * 0.285;

/// Cells around the picture, so that walls at the rim of a map have two edges as well.
const MARGIN: u32 = 4;

/// Edge cells of a map's occupied cells, on the map's lattice (Saeedi et al., section II.B).
///
/// The detector is Canny's with a Gaussian of 1.4 cells: a wall gives an edge on each of its sides.
///
/// # Errors
/// A parameter out of range, or a map over the size limit of a picture.
pub fn detect_edges(
    map: &OccupancyGrid,
    thresholds: &ClassThresholds,
    params: &EdgeParams,
) -> Result<Grid<bool>, RadonError> {
    params.check()?;
    let (width, height) = (map.width(), map.height());
    let side = |cells: usize| u32::try_from(cells).ok().and_then(|c| c.checked_add(2 * MARGIN));
    let (Some(columns), Some(rows)) = (side(width), side(height)) else {
        let limit = ogm_core::MAX_CELLS;
        return Err(GridError::TooLarge { width, height, limit }.into());
    };
    let mut picture = GrayImage::new(columns, rows);
    for (row, cells) in (MARGIN..).zip(map.cells().rows()) {
        for (column, &cell) in (MARGIN..).zip(cells) {
            if thresholds.is_occupied(cell) {
                picture.put_pixel(column, row, Luma([255]));
            }
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "a threshold needs no more than an f32")]
    let [low, high] = [params.low, params.high].map(|share| (share * STEEPEST) as f32);
    let edges = canny(&picture, low, high);
    let mut cells = Vec::with_capacity(width * height);
    for row in edges.rows().skip(MARGIN as usize).take(height) {
        cells.extend(row.skip(MARGIN as usize).take(width).map(|pixel| pixel.0[0] != 0));
    }
    Ok(Grid::new(width, height, cells)?)
}
