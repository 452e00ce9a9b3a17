//! Which maps of a team are one and the same.

use ogm_core::{CellIndex, GridFrame, Occupancy, OccupancyGrid};

use crate::RobotMap;

/// Lattices that are off by less than this share of a cell are one.
const SAME: f64 = 1e-6;

/// Maps that know the same cells in the same place as another, as (copy, original): the reference,
/// or else the first, stands for them.
pub(super) fn copies(maps: &[RobotMap<'_>], reference: usize) -> Vec<(usize, usize)> {
    let known: Vec<Known<'_>> = maps.iter().map(|map| Known::of(map.map)).collect();
    let order = || {
        (0..maps.len())
            .map(|map| if map == 0 { reference } else { map - usize::from(map <= reference) })
    };
    let mut originals: Vec<usize> = Vec::new();
    let mut copies = Vec::new();
    for map in order() {
        match originals.iter().find(|&&other| known[other].is_same(&known[map])) {
            Some(&original) => copies.push((map, original)),
            None => originals.push(map),
        }
    }
    copies.sort_unstable();
    copies
}

/// A map without the unknown around what it knows; all of it where it knows nothing.
struct Known<'a> {
    map: &'a OccupancyGrid,
    low: CellIndex,
    high: CellIndex,
    frame: GridFrame,
}

impl<'a> Known<'a> {
    fn of(map: &'a OccupancyGrid) -> Self {
        let all = (
            CellIndex { column: 0, row: 0 },
            CellIndex { column: map.width() - 1, row: map.height() - 1 },
        );
        let (low, high) = map.cells().bounds_of(|cell| cell.is_known()).unwrap_or(all);
        let frame = map.frame().shifted(low.column as i64, low.row as i64);
        Self { map, low, high, frame }
    }

    fn rows(&self) -> impl Iterator<Item = &[Occupancy]> {
        let cells = self.map.cells();
        (self.low.row..=self.high.row)
            .map(|row| &cells.row(row)[self.low.column..=self.high.column])
    }

    fn is_same(&self, other: &Self) -> bool {
        let size = |known: &Self| {
            [known.high.column - known.low.column + 1, known.high.row - known.low.row + 1]
        };
        let [width, height] = size(self);
        if [width, height] != size(other) || !self.frame.same_resolution(&other.frame) {
            return false;
        }
        let off = self.frame.map_from_grid().between(&other.frame.map_from_grid());
        let turned = off.theta().abs() * width.max(height) as f64;
        turned <= SAME
            && off.translation().norm() <= SAME * self.frame.resolution()
            && self.rows().eq(other.rows())
    }
}
