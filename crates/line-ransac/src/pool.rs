//! The cells that no line has taken yet, laid out so that a vote looks at few of them.

use crate::strip::{Cell, Strip};

/// Cells in one block.
const BLOCK: usize = 16;

/// The cells that no line has taken yet.
///
/// A vote counts the cells inside a strip, and only whether it beats the best vote so far matters.
/// Cells that lie close together share a block, so that a strip misses the bounding boxes of most
/// blocks; those that it reaches are counted in blocks of one fixed size without a branch, until
/// the rest cannot beat the best any more. Neither changes the winner.
///
/// Coordinates and cross products are whole numbers below 2⁵³, so `f64` counts exactly.
#[derive(Debug)]
pub(crate) struct Pool {
    /// Along a Z-order curve.
    cells: Vec<Cell>,
    /// Of the bounding box at the start; coordinates in blocks are relative to it.
    centre: Cell,
    blocks: Vec<Block>,
    boxes: Boxes,
    /// Scratch: by how much the strip misses each box, and the blocks that it does not miss.
    missed_by: Vec<f64>,
    reached: Vec<usize>,
}

/// Coordinates of cells; what is left over at the end is NaN, which lies in no strip.
#[derive(Debug)]
struct Block {
    x: [f64; BLOCK],
    y: [f64; BLOCK],
}

/// Bounding boxes of blocks.
#[derive(Debug, Default)]
struct Boxes {
    centre_x: Vec<f64>,
    centre_y: Vec<f64>,
    half_width: Vec<f64>,
    half_height: Vec<f64>,
}

/// A strip in the coordinates of the blocks.
#[derive(Clone, Copy)]
struct LocalStrip {
    along_x: f64,
    along_y: f64,
    offset: f64,
    limit: f64,
}

impl Pool {
    pub(crate) fn new(mut cells: Vec<Cell>) -> Self {
        cells.sort_by_cached_key(|&cell| z_order(cell));
        let [x, y] = [0, 1].map(|axis| middle(cells.iter().map(|cell| cell[axis])));
        let mut pool = Self {
            cells,
            centre: [x, y],
            blocks: Vec::new(),
            boxes: Boxes::default(),
            missed_by: Vec::new(),
            reached: Vec::new(),
        };
        pool.rebuild_blocks();
        pool
    }

    pub(crate) fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The cells inside `strip`.
    pub(crate) fn inside(&self, strip: &Strip) -> Vec<Cell> {
        let inside = self.cells.iter().filter(|&&cell| strip.contains(cell));
        inside.copied().collect()
    }

    /// Removes and returns the cells inside `strip`.
    pub(crate) fn take(&mut self, strip: &Strip) -> Vec<Cell> {
        let taken = self.cells.extract_if(.., |&mut cell| strip.contains(cell));
        let taken = taken.collect();
        self.rebuild_blocks();
        taken
    }

    /// The number of cells inside `strip` if it is above `to_beat`; otherwise some number that is
    /// not above it.
    pub(crate) fn votes(&mut self, strip: &Strip, to_beat: usize) -> usize {
        let strip = self.localise(strip);
        let reached = self.reach(&strip);
        let mut open = reached * BLOCK;
        let mut votes = 0;
        for &block in &self.reached[..reached] {
            if votes + open <= to_beat {
                return votes;
            }
            votes += self.blocks[block].votes(&strip);
            open -= BLOCK;
        }
        votes
    }

    /// Lists the blocks whose box `strip` reaches and returns their number.
    fn reach(&mut self, strip: &LocalStrip) -> usize {
        let Boxes { centre_x, centre_y, half_width, half_height } = &self.boxes;
        let (across_width, across_height) = (strip.along_y.abs(), strip.along_x.abs());
        let boxes = centre_x.iter().zip(centre_y).zip(half_width).zip(half_height);
        for (missed_by, (((&x, &y), &half_width), &half_height)) in
            self.missed_by.iter_mut().zip(boxes)
        {
            let extent = across_width * half_width + across_height * half_height;
            *missed_by = strip.cross(x, y).abs() - extent - strip.limit;
        }
        let mut count = 0;
        for (block, &missed_by) in self.missed_by.iter().enumerate() {
            self.reached[count] = block;
            count += usize::from(missed_by < 0.0);
        }
        count
    }

    fn localise(&self, strip: &Strip) -> LocalStrip {
        let [along_x, along_y] = strip.along();
        LocalStrip {
            along_x: along_x as f64,
            along_y: along_y as f64,
            offset: strip.cross(self.centre) as f64,
            limit: strip.limit(),
        }
    }

    fn rebuild_blocks(&mut self) {
        let Self { cells, centre, blocks, boxes, .. } = self;
        blocks.clear();
        boxes.clear();
        for members in cells.chunks(BLOCK) {
            let mut block = Block { x: [f64::NAN; BLOCK], y: [f64::NAN; BLOCK] };
            for (&[column, row], (x, y)) in members.iter().zip(block.x.iter_mut().zip(&mut block.y))
            {
                *x = f64::from(column - centre[0]);
                *y = f64::from(row - centre[1]);
            }
            boxes.push(&block);
            blocks.push(block);
        }
        self.missed_by.resize(self.blocks.len(), 0.0);
        self.reached.resize(self.blocks.len(), 0);
    }
}

impl Block {
    fn votes(&self, strip: &LocalStrip) -> usize {
        let mut votes = 0_u32;
        for (&x, &y) in self.x.iter().zip(&self.y) {
            votes += u32::from(strip.cross(x, y).abs() < strip.limit);
        }
        votes as usize
    }
}

impl Boxes {
    fn clear(&mut self) {
        self.centre_x.clear();
        self.centre_y.clear();
        self.half_width.clear();
        self.half_height.clear();
    }

    fn push(&mut self, block: &Block) {
        let (x, half_width) = whole_interval(&block.x);
        let (y, half_height) = whole_interval(&block.y);
        self.centre_x.push(x);
        self.centre_y.push(y);
        self.half_width.push(half_width);
        self.half_height.push(half_height);
    }
}

/// Whole numbers (centre, half width) of an interval around `values`.
fn whole_interval(values: &[f64]) -> (f64, f64) {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let centre = ((least + most) / 2.0).floor();
    (centre, most - centre)
}

impl LocalStrip {
    fn cross(&self, x: f64, y: f64) -> f64 {
        self.along_x * y - self.along_y * x + self.offset
    }
}

fn middle(values: impl Iterator<Item = i32> + Clone) -> i32 {
    let least = values.clone().min().unwrap_or(0);
    let most = values.max().unwrap_or(0);
    least + (most - least) / 2
}

/// Place on the Z-order curve: the bits of column and row interleaved.
fn z_order([column, row]: Cell) -> u64 {
    spread(column) | (spread(row) << 1)
}

/// Moves bit k to bit 2k.
fn spread(coordinate: i32) -> u64 {
    let mut bits = u64::from(coordinate.cast_unsigned());
    for (shift, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ] {
        bits = (bits | (bits << shift)) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::Pool;
    use crate::strip::Strip;
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn votes_are_exact_above_what_they_must_beat(
            cells in prop::collection::vec([0_i32..2800, 0_i32..2800], 2..400),
            b in [0_i32..2800, 0_i32..2800], c in [0_i32..2800, 0_i32..2800],
            distance in prop::sample::select(vec![0.0, 1.5, 2.0, 40.0, 1e9]),
            to_beat in 0_usize..60,
        ) {
            let mut pool = Pool::new(cells.clone());
            let strip = Strip::new(b, c, distance);
            let exact = cells.iter().filter(|&&cell| strip.contains(cell)).count();
            let votes = pool.votes(&strip, to_beat);
            prop_assert!(votes == exact || votes.max(exact) <= to_beat, "{votes} of {exact}");

            let before = pool.cells().len();
            let taken = pool.take(&strip);
            prop_assert_eq!(taken.len(), exact);
            prop_assert_eq!(pool.cells().len() + exact, before);
            prop_assert_eq!(pool.votes(&strip, 0), 0, "what was taken votes no more");
        }
    }

    #[test]
    fn an_empty_pool_has_no_votes() {
        assert_eq!(Pool::new(Vec::new()).votes(&Strip::new([0, 0], [5, 5], 2.0), 0), 0);
    }
}
