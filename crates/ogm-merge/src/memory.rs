//! What aligning and fusing maps takes, told from their sizes before the work.

/// The most memory that aligning maps of these numbers of cells takes at one time beyond the cells
/// themselves, and fusing them where they lie on each other, bytes.
///
/// Measured, not derived: the peak of the command on pairs of 600 to 20 000 cells a side, of which
/// every cell is known. `crates/ogm-cli/tests/it/memory.rs` holds it against runs.
#[must_use]
pub fn working_bytes(cells: &[u64]) -> u64 {
    let matching = cells.iter().map(|&cells| prepared_bytes(cells)).sum();
    // A byte and a half for each cell of the fused map.
    let fusing = cells.iter().max().map_or(0, |&largest| largest.saturating_add(largest / 2));
    u64::max(matching, fusing)
}

/// Of one map while it is searched: what is known of each cell, on coarser cells from some size on.
fn prepared_bytes(cells: u64) -> u64 {
    const MOST_CELLS: u64 = 1 << 24;
    const OF_A_CELL: u64 = 16;
    const OF_A_COARSER_CELL: u64 = 40;
    let mut kept = cells;
    while kept > MOST_CELLS {
        kept /= 4;
    }
    kept * if kept == cells { OF_A_CELL } else { OF_A_COARSER_CELL }
}
