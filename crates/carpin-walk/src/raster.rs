//! The source map on the target's lattice, cell by cell.

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
    let (width, height) = (source.codes.width() as u64, source.codes.height() as u64);
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

    let steps = [cos, -sin].map(to_fixed);
    let codes = source.codes.cells();
    for row in rows {
        // Source cells of the centre of this row's column 0.
        let (x, y) = (0.5 - moved[0], row as f64 + 0.5 - moved[1]);
        let start = [cos * x + sin * y + from[0], -sin * x + cos * y + from[1]];
        let columns = columns_inside(start, [cos, -sin], size, canvas);
        let first = columns.start as f64;
        let mut u = to_fixed(start[0] + cos * first);
        let mut v = to_fixed(start[1] - sin * first);
        for column in columns {
            // A negative coordinate is a large one without its sign.
            let (at, up) = ((u >> 32).cast_unsigned(), (v >> 32).cast_unsigned());
            // The range was found in floating point, so its ends may be one cell off.
            if at < width && up < height {
                #[expect(clippy::cast_possible_truncation, reason = "a position in the map")]
                let code = codes[(up * width + at) as usize];
                if code != NEITHER {
                    visit(column, row, code);
                }
            }
            u = u.wrapping_add(steps[0]);
            v = v.wrapping_add(steps[1]);
        }
    }
}

/// Columns of the canvas that can fall on the source, at most one too many at each end.
fn columns_inside(
    start: [f64; 2],
    step: [f64; 2],
    size: [f64; 2],
    canvas: CellBox,
) -> std::ops::Range<i64> {
    let (low, high) = (canvas.low[0], canvas.high[0]);
    let (mut from, mut to) = (low as f64, high as f64);
    for axis in 0..2 {
        if step[axis].abs() < 1e-12 {
            if start[axis] < -1.0 || start[axis] > size[axis] + 1.0 {
                return low..low;
            }
        } else {
            let (a, b) = (-start[axis] / step[axis], (size[axis] - start[axis]) / step[axis]);
            from = from.max(a.min(b).floor() - 1.0);
            to = to.min(a.max(b).ceil() + 1.0);
        }
    }
    let (from, to) = (clamped(from, low, high), clamped(to, low, high));
    from..to.max(from)
}

#[expect(clippy::cast_possible_truncation, reason = "clamped to the canvas after it saturates")]
fn clamped(cell: f64, low: i64, high: i64) -> i64 {
    (cell as i64).clamp(low, high)
}

/// A coordinate with 32 fractional bits: two integer additions a cell.
#[expect(clippy::cast_possible_truncation, reason = "saturates; far outside any map")]
fn to_fixed(x: f64) -> i64 {
    (x * 4_294_967_296.0).round() as i64
}
