//! What aligning and fusing maps takes, told from their sizes before the work.

use ogm_core::MAX_CELLS;

/// The most cells of a map in which it is worth the time and memory to look for bends unasked.
///
/// A bend is alike over some metres, and the patches that follow it are limited in number: in larger
/// maps a patch is larger than what bends alike. Such maps are searched on coarser cells, too.
pub const MOST_BENT_CELLS: u64 = MOST_FINE_CELLS;

/// Maps of more are searched on coarser cells.
const MOST_FINE_CELLS: u64 = 1 << 24;

/// The most memory that aligning maps of these numbers of cells takes at one time beyond the cells
/// themselves, bytes.
///
/// Measured, not derived: the peak of the command on pairs of 600 to 20 000 cells a side, of which
/// every cell is known. `crates/ogm-cli/tests/it/memory.rs` holds it against runs.
#[must_use]
pub fn aligning_bytes(cells: &[u64]) -> u64 {
    cells.iter().map(|&cells| prepared_bytes(cells)).sum()
}

/// The most memory that making maps straight takes at one time beyond the cells themselves, bytes:
/// the walls of all, and every map but the reference as it comes out.
///
/// Measured as [`aligning_bytes`], on maps of 20 000 cells a side of which a fiftieth is wall.
#[must_use]
pub fn bending_bytes(cells: &[u64]) -> u64 {
    const WALLS_OF_A_CELL: u64 = 2;
    let all: u64 = cells.iter().sum();
    let reference = cells.iter().copied().min().unwrap_or(0);
    all * WALLS_OF_A_CELL + (all - reference)
}

/// The memory that fusing takes beyond the cells of the maps themselves, bytes, where they lie on
/// each other: where they do not, the fused map is larger.
///
/// `largest` is the number of cells of the largest map, and `refined` how many cells of the fused
/// map one of its cells becomes.
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
pub fn fusing_bytes(largest: u64, refined: f64) -> u64 {
    let of_a_cell = if refined == 1.0 { 1.5 } else { 3.0 };
    // A larger one is refused by itself.
    let cells = (largest as f64 * refined).min(MAX_CELLS as f64);
    (cells * of_a_cell) as u64
}

/// Of one map while it is searched: what is known of each cell, on coarser cells from some size on.
fn prepared_bytes(cells: u64) -> u64 {
    const OF_A_CELL: u64 = 12;
    const OF_A_COARSER_CELL: u64 = 25;
    let mut kept = cells;
    while kept > MOST_FINE_CELLS {
        kept /= 4;
    }
    kept * if kept == cells { OF_A_CELL } else { OF_A_COARSER_CELL }
}
