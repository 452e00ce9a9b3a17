//! The source map on the target's lattice, cell by cell.

use nalgebra::{Point2, Vector2};
use ogm_core::CellsOnLine;

use crate::Placement;
use crate::class_map::{ClassMap, NEITHER};

/// Cells of the target's lattice from `low` to `high`, the latter exclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CellBox {
    pub(crate) low: [i64; 2],
    pub(crate) high: [i64; 2],
}

/// Calls `visit` with column, row and code of each cell of `canvas` whose centre lies on a source
/// cell of either class when the source's reference point is moved to `placement` from
/// `target_centre` and the source is turned about it (Carpin and Birk, Definition 2).
///
/// Inverse mapping by nearest cell, so that the source has no gaps.
pub(crate) fn place(
    source: &ClassMap,
    placement: &Placement,
    target_centre: [f64; 2],
    canvas: CellBox,
    mut visit: impl FnMut(i64, i64, u8),
) {
    let (sin, cos) = placement[2].to_radians().sin_cos();
    let moved = [target_centre[0] + placement[0], target_centre[1] + placement[1]];
    let centre = source.centre();
    let from = [centre[0] - source.first[0] as f64, centre[1] - source.first[1] as f64];
    let (width, height) = (source.codes.width(), source.codes.height());
    let size = [width as f64, height as f64];

    // Rows of the canvas that the turned rectangle of the source can reach.
    let ends = [[0.0, 0.0], [size[0], 0.0], [0.0, size[1]], size].map(|[x, y]| {
        let (x, y) = (x - from[0], y - from[1]);
        moved[1] + sin * x + cos * y
    });
    let lowest = ends.into_iter().fold(f64::INFINITY, f64::min);
    let highest = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let rows = clamped(lowest.floor(), canvas.low[1], canvas.high[1])
        ..clamped(highest.ceil(), canvas.low[1], canvas.high[1]);

    let codes = source.codes.cells();
    for row in rows {
        // Source cells of the centre of this row's column 0.
        let (x, y) = (0.5 - moved[0], row as f64 + 0.5 - moved[1]);
        let start = Point2::new(cos * x + sin * y + from[0], -sin * x + cos * y + from[1]);
        let along = canvas.low[0]..canvas.high[0];
        let cells = CellsOnLine::new(start, Vector2::new(cos, -sin), along, (width, height));
        for (column, position) in (cells.first()..).zip(cells) {
            if let Some(code) = position.map(|position| codes[position]).filter(|&c| c != NEITHER) {
                visit(column, row, code);
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "clamped to the canvas after it saturates")]
fn clamped(cell: f64, low: i64, high: i64) -> i64 {
    (cell as i64).clamp(low, high)
}
