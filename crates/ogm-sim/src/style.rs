//! How maps look that different mappers saved and different people edited.

use ogm_core::{CellClass, CellIndex, ClassThresholds, Grid, Occupancy, OccupancyGrid};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::draw::{Stream, generator};
use crate::pieces::pieces;

/// Probability one half: known and undecided.
const GREY: Occupancy = Occupancy::from_byte(127);
/// Side of the blocks over which a mapper behaves alike, metres.
const BLOCK_M: f64 = 0.6;
/// Wall in smaller pieces is wiped off by who cleans a map, metres of its longer side.
const SPECK_M: f64 = 0.25;
/// And furniture is left out of a plan, metres of its longer side.
const FURNITURE_M: f64 = 1.5;

/// Who made a map.
///
/// What each does was read off public map files: wall of one cell with free space on both sides,
/// grey fringes, gaps in walls, single cells, solid black or white around the building.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MapStyle {
    /// The simulator's own mapper: wall with unknown behind.
    Plain,
    /// Thin wall, often with free space on both sides, and a grey fringe.
    Cartographer,
    /// Thick wall, and rays that leave through windows.
    GMapping,
    /// Single cells of wall in the free space, and gaps of single cells.
    Hector,
    /// Wall with many gaps.
    Karto,
    /// Specks removed, holes filled; outside is unknown, black or white.
    HandCleaned,
    /// A plan: lines on white, without furniture or unknown.
    HandDrawn,
}

impl MapStyle {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Plain,
        Self::Cartographer,
        Self::GMapping,
        Self::Hector,
        Self::Karto,
        Self::HandCleaned,
        Self::HandDrawn,
    ];

    /// A short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Cartographer => "Cartographer",
            Self::GMapping => "GMapping",
            Self::Hector => "Hector",
            Self::Karto => "Karto",
            Self::HandCleaned => "hand-cleaned",
            Self::HandDrawn => "hand-drawn",
        }
    }

    /// `map` as it would look in this style; what is random is decided by `seed`.
    #[must_use]
    pub fn apply(self, map: &OccupancyGrid, seed: u64) -> OccupancyGrid {
        let mut rng = generator(seed, Stream::Style, self as u64);
        let classes = map.cells().map(|&cell| ClassThresholds::default().classify(cell));
        let mut page =
            Page { cells: map.cells().clone(), classes, cell_m: map.frame().resolution() };
        match self {
            Self::Plain => {}
            Self::Cartographer => page.cartographer(&mut rng),
            Self::GMapping => page.gmapping(&mut rng),
            Self::Hector => page.hector(&mut rng),
            Self::Karto => page.karto(&mut rng),
            Self::HandCleaned => page.hand_cleaned(&mut rng),
            Self::HandDrawn => page.hand_drawn(),
        }
        OccupancyGrid::new(*map.frame(), page.cells)
    }
}

/// A map under the pen: `classes` as it was, `cells` as it becomes.
struct Page {
    cells: Grid<Occupancy>,
    classes: Grid<CellClass>,
    cell_m: f64,
}

impl Page {
    fn cartographer(&mut self, rng: &mut ChaCha8Rng) {
        let share = rng.random_range(0.2..0.9);
        let blocks = self.blocks(rng);
        for at in 0..self.cells.cells().len() {
            let index = self.cells.index_of(at);
            match self.class(index) {
                CellClass::Occupied if !self.touches(index, CellClass::Free) => {
                    self.set(index, Occupancy::UNKNOWN);
                }
                CellClass::Unknown if self.touches(index, CellClass::Occupied) => {
                    let is_thin = blocks.at(index, self.cell_m) < share;
                    self.set(index, if is_thin { Occupancy::FREE } else { GREY });
                }
                CellClass::Unknown if self.touches(index, CellClass::Free) => self.set(index, GREY),
                _ => {}
            }
        }
    }

    fn gmapping(&mut self, rng: &mut ChaCha8Rng) {
        let share = rng.random_range(0.2..0.7);
        for at in 0..self.cells.cells().len() {
            let index = self.cells.index_of(at);
            let is_behind =
                self.class(index) == CellClass::Unknown && self.touches(index, CellClass::Occupied);
            if is_behind && rng.random_bool(share) {
                self.set(index, Occupancy::OCCUPIED);
            }
        }
        for _ in 0..rng.random_range(0..8) {
            self.ray(rng);
        }
    }

    /// Free space along a line from somewhere in the map out to a few metres.
    fn ray(&mut self, rng: &mut ChaCha8Rng) {
        let (width, height) = (self.cells.width() as f64, self.cells.height() as f64);
        let (mut x, mut y) = (rng.random_range(0.0..width), rng.random_range(0.0..height));
        let (sin, cos) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
        let steps = rng.random_range(1.0..6.0) / self.cell_m;
        let mut step = 0.0;
        while step < steps && x >= 0.0 && y >= 0.0 && x < width && y < height {
            let index = cell_of(x, y);
            if self.class(index) == CellClass::Unknown {
                self.set(index, Occupancy::FREE);
            }
            (x, y, step) = (x + cos, y + sin, step + 1.0);
        }
    }

    fn hector(&mut self, rng: &mut ChaCha8Rng) {
        let salt = rng.random_range(0.0..0.01);
        let gaps = rng.random_range(0.0..0.1);
        self.sprinkle(CellClass::Free, Occupancy::OCCUPIED, salt, rng);
        self.sprinkle(CellClass::Occupied, Occupancy::FREE, gaps, rng);
    }

    fn karto(&mut self, rng: &mut ChaCha8Rng) {
        let (gaps, holes) = (rng.random_range(0.1..0.4), rng.random_range(0.0..0.02));
        self.sprinkle(CellClass::Occupied, Occupancy::UNKNOWN, gaps, rng);
        self.sprinkle(CellClass::Free, Occupancy::UNKNOWN, holes, rng);
    }

    fn hand_cleaned(&mut self, rng: &mut ChaCha8Rng) {
        self.erase_wall_below(SPECK_M);
        let outside =
            [Occupancy::UNKNOWN, Occupancy::OCCUPIED, Occupancy::FREE][rng.random_range(0..3)];
        for piece in pieces(&self.classes, |class| *class == CellClass::Unknown) {
            let fill = if piece.is_open { outside } else { Occupancy::FREE };
            // A hole the size of a pillar is one.
            if piece.is_open || piece.longer_side() * self.cell_m < 1.0 {
                for &at in &piece.cells {
                    self.cells.cells_mut()[at] = fill;
                }
            }
        }
    }

    fn hand_drawn(&mut self) {
        self.erase_wall_below(FURNITURE_M);
        for at in 0..self.cells.cells().len() {
            let index = self.cells.index_of(at);
            let is_line = self.class(index) == CellClass::Occupied
                && self.cells.cells()[at] == Occupancy::OCCUPIED
                && self.touches(index, CellClass::Free);
            self.set(index, if is_line { Occupancy::OCCUPIED } else { Occupancy::FREE });
        }
    }

    /// Small pieces of wall become free; what stays is drawn in one black.
    fn erase_wall_below(&mut self, side_m: f64) {
        for piece in pieces(&self.classes, |class| *class == CellClass::Occupied) {
            let is_small = piece.longer_side() * self.cell_m < side_m;
            let ink = if is_small { Occupancy::FREE } else { Occupancy::OCCUPIED };
            for &at in &piece.cells {
                self.cells.cells_mut()[at] = ink;
            }
        }
    }

    fn sprinkle(&mut self, on: CellClass, ink: Occupancy, share: f64, rng: &mut ChaCha8Rng) {
        for (cell, class) in self.cells.cells_mut().iter_mut().zip(self.classes.cells()) {
            if *class == on && rng.random_bool(share) {
                *cell = ink;
            }
        }
    }

    fn class(&self, index: CellIndex) -> CellClass {
        self.classes.get(index).copied().unwrap_or(CellClass::Unknown)
    }

    fn set(&mut self, index: CellIndex, value: Occupancy) {
        if let Some(cell) = self.cells.get_mut(index) {
            *cell = value;
        }
    }

    /// Whether one of the eight neighbours is of this class.
    fn touches(&self, index: CellIndex, class: CellClass) -> bool {
        let CellIndex { column, row } = index;
        (row.saturating_sub(1)..=row + 1).any(|near_row| {
            (column.saturating_sub(1)..=column + 1).any(|near_column| {
                let near = CellIndex { column: near_column, row: near_row };
                near != index && self.classes.get(near) == Some(&class)
            })
        })
    }

    fn blocks(&self, rng: &mut ChaCha8Rng) -> Blocks {
        let across = |cells: usize| whole(cells as f64 * self.cell_m / BLOCK_M) + 1;
        let (columns, rows) = (across(self.cells.width()), across(self.cells.height()));
        Blocks { columns, values: (0..columns * rows).map(|_| rng.random()).collect() }
    }
}

/// One random number from 0 to 1 for each block of a map.
struct Blocks {
    columns: usize,
    values: Vec<f64>,
}

impl Blocks {
    fn at(&self, index: CellIndex, cell_m: f64) -> f64 {
        let block = |cell: usize| whole(cell as f64 * cell_m / BLOCK_M);
        self.values[block(index.row) * self.columns + block(index.column)]
    }
}

fn cell_of(x: f64, y: f64) -> CellIndex {
    CellIndex { column: whole(x), row: whole(y) }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a grid")]
fn whole(x: f64) -> usize {
    x as usize
}

#[cfg(test)]
mod tests {
    use super::MapStyle;
    use crate::{FloorKind, MapStyle as Style, Relation, labelled_pair};
    use ogm_core::{CellClass, ClassThresholds, OccupancyGrid};

    fn shares(map: &OccupancyGrid) -> [f64; 3] {
        let thresholds = ClassThresholds::default();
        let of = |class: CellClass| {
            let cells = map.cells().cells();
            let count = cells.iter().filter(|&&cell| thresholds.classify(cell) == class).count();
            count as f64 / cells.len() as f64
        };
        [of(CellClass::Unknown), of(CellClass::Free), of(CellClass::Occupied)]
    }

    fn plain() -> OccupancyGrid {
        let mut seeds = 0_u64..200;
        seeds
            .find_map(|seed| {
                let pair = labelled_pair(FloorKind::Offices, Relation::Overlapping, seed).ok()?;
                (pair.styles[0] == Style::Plain).then_some(pair.target)
            })
            .unwrap()
    }

    #[test]
    fn each_style_shows_what_it_is_known_for() {
        let map = plain();
        let [unknown, free, wall] = shares(&map);
        let of = |style: MapStyle| shares(&style.apply(&map, 7));
        assert_eq!(MapStyle::Plain.apply(&map, 7), map);
        assert_eq!(of(MapStyle::HandDrawn)[0], 0.0, "nothing unknown");
        assert!(of(MapStyle::HandDrawn)[2] < wall, "lines and no furniture");
        assert!(of(MapStyle::Cartographer)[1] > free, "free behind thin walls");
        assert!(of(MapStyle::GMapping)[2] > wall, "thick walls");
        assert!(of(MapStyle::Karto)[2] < 0.95 * wall, "gaps");
        assert!(of(MapStyle::HandCleaned) != [unknown, free, wall]);
    }

    #[test]
    fn a_seed_is_a_style() {
        let map = plain();
        for style in MapStyle::ALL {
            assert_eq!(style.apply(&map, 3), style.apply(&map, 3), "{}", style.name());
        }
        assert_ne!(MapStyle::Karto.apply(&map, 3), MapStyle::Karto.apply(&map, 4));
    }
}
