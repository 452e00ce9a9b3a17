//! The stages from cells to lines, whatever the cells are.

use rand_chacha::ChaCha8Rng;

use crate::breakdown::break_at_gaps;
use crate::detect::{Detection, detect};
use crate::join::{JoinLimits, join};
use crate::line::Line;
use crate::params::{DirectionRule, InCells, Params};
use crate::settle::settle;
use crate::strip::Cell;

/// Lines after each stage.
pub(crate) struct Lines {
    pub(crate) detection: Detection,
    pub(crate) broken: Vec<Line>,
    pub(crate) joined: Vec<Line>,
}

/// Detects lines among `cells`, breaks them at gaps and joins what lies on one wall.
pub(crate) fn lines_of(
    cells: Vec<Cell>,
    limits: &InCells,
    params: &Params,
    rng: &mut ChaCha8Rng,
) -> Lines {
    let detection = detect(cells.clone(), limits.line_distance, params, rng);
    let pieces = |line| break_at_gaps(line, limits.max_gap, params.break_rule, params.direction);
    let mut broken: Vec<Line> = detection.lines.iter().flat_map(pieces).collect();
    if params.direction == DirectionRule::TotalLeastSquares {
        let settled = |piece| settle(piece, &cells, limits.line_distance, rng);
        broken = broken.iter().filter_map(settled).collect();
    }
    let join_limits = JoinLimits { angle: params.join_angle, distance: limits.join_distance };
    let mut joined = join(broken.clone(), join_limits, params.direction);
    // Pieces of one wall may have settled on the same cells.
    for line in &mut joined {
        line.cells.sort_unstable();
        line.cells.dedup();
    }
    Lines { detection, broken, joined }
}
