//! What the benchmarks in `benches/` have in common: their maps and how long each is measured.

use std::time::Duration;

use criterion::Criterion;
use ogm_core::{Grid, OccupancyGrid};
use ogm_sim::{FloorPlan, MappingParams, PairParams, survey};

/// Short measurements: all benchmarks together take about a minute.
#[must_use]
pub fn settings() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500))
        .sample_size(20)
        .without_plots()
}

/// A survey of plan A, 14 × 12 m, at `resolution` metres a cell in a frame turned by `map_heading`
/// radians, with the noise of `seed`.
///
/// # Panics
/// If plan A cannot be mapped like that.
#[must_use]
pub fn plan_a(resolution: f64, map_heading: f64, seed: u64) -> OccupancyGrid {
    let mapping = MappingParams { resolution, ..MappingParams::default() };
    let robots = PairParams { seed, mapping, ..PairParams::default() };
    survey(&FloorPlan::plan_a(), map_heading, &robots).expect("plan A can be mapped").map
}

/// The map of the size in Tsardoulias et al., section 5.1: 700 × 600 cells of 0.02 m.
///
/// # Panics
/// If plan A cannot be mapped.
#[must_use]
pub fn reference_map() -> OccupancyGrid {
    plan_a(0.02, 0.0, 0)
}

/// The maps that cell-by-cell work is measured on, with their names: the [`reference_map`], and its
/// copies side by side on 2000 × 2000 cells.
///
/// # Panics
/// If plan A cannot be mapped.
#[must_use]
pub fn maps() -> [(&'static str, OccupancyGrid); 2] {
    let map = reference_map();
    let large = tiled(&map, 2000);
    [("700x600", map), ("2000x2000", large)]
}

/// Copies of `map` side by side, cut to `side` × `side` cells, in its frame.
///
/// # Panics
/// If that is no size of a grid.
#[must_use]
pub fn tiled(map: &OccupancyGrid, side: usize) -> OccupancyGrid {
    let row = |row: usize| map.cells().row(row % map.height()).iter().cycle().take(side);
    let cells = (0..side).flat_map(row).copied().collect();
    OccupancyGrid::new(*map.frame(), Grid::new(side, side, cells).expect("side × side cells"))
}
