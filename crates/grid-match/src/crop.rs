//! The known part of a map, its cells classified.

use ogm_core::{CellClass, CellIndex, ClassThresholds, OccupancyGrid, Se2};

use crate::lattice::{Lattice, floor_index};

/// Empty border around the known cells, metres, so that walls at their edge attract from outside.
const BORDER_M: f64 = 0.8;
/// Most cells after coarsening: a square of 200 m a side at 0.05 m.
const MOST_CELLS: usize = 1 << 24;

/// What a map says of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum State {
    Unknown,
    Free,
    Occupied,
}

/// The known part of a map with a border around.
pub(crate) struct Crop {
    pub(crate) state: Vec<State>,
    pub(crate) lattice: Lattice,
    pub(crate) map_from_local: Se2,
}

impl Crop {
    pub(crate) fn of(map: &OccupancyGrid, thresholds: &ClassThresholds) -> Self {
        let classes = map.cells().map(|&cell| match thresholds.classify(cell) {
            CellClass::Occupied => State::Occupied,
            CellClass::Free => State::Free,
            CellClass::Undecided | CellClass::Unknown => State::Unknown,
        });
        let bounds = classes.bounds_of(|&cell| cell != State::Unknown);
        let origin = CellIndex { column: 0, row: 0 };
        // One cell if nothing is known.
        let (low, high) = bounds.unwrap_or((origin, origin));
        let [left, bottom] = [low.column, low.row];
        let (width, height) = (high.column - left + 1, high.row - bottom + 1);
        let mut factor = 1;
        while (width / factor) * (height / factor) > MOST_CELLS {
            factor *= 2;
        }
        let resolution = map.frame().resolution() * factor as f64;
        let border = floor_index(BORDER_M / resolution).min(64) + 1;
        let lattice = Lattice {
            width: width.div_ceil(factor) + 2 * border,
            height: height.div_ceil(factor) + 2 * border,
            resolution,
        };
        let mut state = vec![State::Unknown; lattice.width * lattice.height];
        for row in 0..height {
            let known = &classes.row(bottom + row)[left..left + width];
            let output = &mut state[(row / factor + border) * lattice.width + border..];
            for (column, &cell) in known.iter().enumerate() {
                let kept = &mut output[column / factor];
                *kept = cell.max(*kept);
            }
        }
        let origin = map.frame().map_from_grid();
        let fine = map.frame().resolution();
        let inset = border as f64 * resolution;
        let corner = Se2::new(left as f64 * fine - inset, bottom as f64 * fine - inset, 0.0);
        Self { state, lattice, map_from_local: origin * corner }
    }
}
