//! The known part of a map on the cells that the search works on.

use ogm_core::{CellClass, CellIndex, ClassThresholds, Occupancy, OccupancyGrid, Se2};

use crate::lattice::{Lattice, floor_index};
use crate::sides::margin;
use crate::state::State;
use crate::visible::{halo, visible_walls};

/// Empty border around the known cells, metres, so that walls at their edge attract from outside.
const BORDER_M: f64 = 0.8;
/// Most working cells: a square of 200 m a side at 0.05 m.
const MOST_CELLS: usize = 1 << 24;
/// Rows of a map that are looked at together.
const BAND: usize = 512;

/// The known part of a map with a border around.
pub(crate) struct Crop {
    pub(crate) state: Vec<State>,
    pub(crate) lattice: Lattice,
    pub(crate) map_from_local: Se2,
    /// The middle of the wall in each cell, from the middle of the cell in 1/200 of its side; empty
    /// where working cells are the map's own.
    pub(crate) offsets: Vec<[i8; 2]>,
}

impl Crop {
    pub(crate) fn of(map: &OccupancyGrid, thresholds: &ClassThresholds) -> Self {
        let class = |cell| match thresholds.classify(cell) {
            CellClass::Occupied => State::Wall,
            CellClass::Free => State::Free,
            CellClass::Undecided | CellClass::Unknown => State::Unknown,
        };
        let table: Vec<State> =
            (0..=u8::MAX).map(|byte| class(Occupancy::from_byte(byte))).collect();
        let state = |cell: &Occupancy| table[usize::from(cell.byte())];
        let bounds = map.cells().bounds_of(|cell| state(cell) != State::Unknown);
        let origin = CellIndex { column: 0, row: 0 };
        // One cell if nothing is known.
        let (low, high) = bounds.unwrap_or((origin, origin));
        let [left, bottom] = [low.column, low.row];
        let (width, height) = (high.column - left + 1, high.row - bottom + 1);
        let mut factor = 1;
        while (width / factor) * (height / factor) > MOST_CELLS {
            factor *= 2;
        }
        let fine = map.frame().resolution();
        let resolution = fine * factor as f64;
        let border = floor_index(BORDER_M / resolution).min(64).max(margin(resolution)) + 1;
        let [columns, rows] = [width, height].map(|fine| fine.div_ceil(factor) + 2 * border);
        let lattice = Lattice::new(columns, rows, resolution);
        let inset = border as f64 * resolution;
        let corner = Se2::new(left as f64 * fine - inset, bottom as f64 * fine - inset, 0.0);
        let map_from_local = map.frame().map_from_grid() * corner;

        let mut page = Page::new(lattice, border, factor);
        let halo = halo(fine);
        let mut row = 0;
        while row < height {
            let rows = BAND.next_multiple_of(factor).min(height - row);
            let (low, high) = (row.saturating_sub(halo), (row + rows + halo).min(height));
            let mut band = Vec::with_capacity((high - low) * width);
            for above in low..high {
                let cells = &map.cells().row(bottom + above)[left..left + width];
                band.extend(cells.iter().map(state));
            }
            visible_walls(&mut band, width, fine);
            let seen = &band[(row - low) * width..][..rows * width];
            page.add(seen, width, row);
            row += rows;
        }
        page.into_crop(map_from_local)
    }
}

/// Working cells under construction.
struct Page {
    lattice: Lattice,
    border: usize,
    factor: usize,
    state: Vec<State>,
    offsets: Vec<[i8; 2]>,
}

impl Page {
    fn new(lattice: Lattice, border: usize, factor: usize) -> Self {
        let cells = lattice.width * lattice.height;
        let offsets = if factor == 1 { Vec::new() } else { vec![[0; 2]; cells] };
        Self { lattice, border, factor, state: vec![State::Unknown; cells], offsets }
    }

    /// Adds whole rows of the map, `first` being the lowest.
    fn add(&mut self, cells: &[State], width: usize, first: usize) {
        let working = first / self.factor + self.border;
        if self.factor == 1 {
            for (row, cells) in cells.chunks_exact(width).enumerate() {
                let at = (working + row) * self.lattice.width + self.border;
                self.state[at..at + width].copy_from_slice(cells);
            }
            return;
        }
        let mut sums = vec![Share::default(); width.div_ceil(self.factor)];
        for (block, rows) in cells.chunks(width * self.factor).enumerate() {
            sums.fill(Share::default());
            for (row, cells) in rows.chunks_exact(width).enumerate() {
                for (column, &cell) in cells.iter().enumerate() {
                    sums[column / self.factor].add(cell, [column % self.factor, row]);
                }
            }
            let at = (working + block) * self.lattice.width + self.border;
            for (column, share) in sums.iter().enumerate() {
                (self.state[at + column], self.offsets[at + column]) = share.cell(self.factor);
            }
        }
    }

    fn into_crop(self, map_from_local: Se2) -> Crop {
        let Self { lattice, state, offsets, .. } = self;
        Crop { state, lattice, map_from_local, offsets }
    }
}

/// What the cells of the map say that make one working cell.
#[derive(Debug, Clone, Copy, Default)]
struct Share {
    free: usize,
    wall: usize,
    /// Sum of columns and rows of the wall.
    place: [usize; 2],
}

impl Share {
    fn add(&mut self, cell: State, place: [usize; 2]) {
        match cell {
            State::Wall => {
                self.wall += 1;
                self.place = [self.place[0] + place[0], self.place[1] + place[1]];
            }
            State::Free => self.free += 1,
            State::Unknown => {}
        }
    }

    /// Wall where there is any, and where in the cell it is; free where at least half is.
    #[expect(clippy::cast_possible_truncation, reason = "from -100 to 100")]
    fn cell(&self, factor: usize) -> (State, [i8; 2]) {
        if self.wall > 0 {
            let middle = |sum: usize| {
                let share = (sum as f64 / self.wall as f64 + 0.5) / factor as f64;
                (200.0 * (share - 0.5)).round() as i8
            };
            (State::Wall, self.place.map(middle))
        } else if 2 * self.free >= factor * factor {
            (State::Free, [0; 2])
        } else {
            (State::Unknown, [0; 2])
        }
    }
}
