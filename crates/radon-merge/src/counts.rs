//! What two maps say about the same cells, counted class by class.

use ogm_core::{CellClass, ClassThresholds, Grid, OccupancyGrid, Se2, warp_nearest};

use crate::RadonError;

/// Cells by their class in two maps, over all cells that either map covers.
///
/// What is known but undecided counts as unknown: it neither agrees nor disagrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JointCounts {
    /// Occupied in both.
    pub both_occupied: usize,
    /// Free in both.
    pub both_free: usize,
    /// Occupied in the target, free in the source.
    pub occupied_free: usize,
    /// Free in the target, occupied in the source.
    pub free_occupied: usize,
    /// Occupied in the target, unknown in the source.
    pub occupied_unknown: usize,
    /// Free in the target, unknown in the source.
    pub free_unknown: usize,
    /// Unknown in the target, occupied in the source.
    pub unknown_occupied: usize,
    /// Unknown in the target, free in the source.
    pub unknown_free: usize,
    /// Unknown in both.
    pub both_unknown: usize,
}

impl JointCounts {
    /// agr of Eq. 16: known in both and equal.
    #[must_use]
    pub fn agreement(&self) -> usize {
        self.both_occupied + self.both_free
    }

    /// dis of Eq. 16, corrected: known in both and different.
    #[must_use]
    pub fn disagreement(&self) -> usize {
        self.occupied_free + self.free_occupied
    }

    /// Known in exactly one map.
    #[must_use]
    pub fn known_in_one(&self) -> usize {
        self.occupied_unknown + self.free_unknown + self.unknown_occupied + self.unknown_free
    }
}

/// The source laid onto the lattice of the target, ready to be counted at any shift by cells.
pub(crate) struct Overlaid {
    target: Planes,
    /// Classes of the source on the lattice of the target.
    source: Grid<CellClass>,
    /// Column and row in the target of the source's first cell.
    corner: [i64; 2],
    target_totals: [usize; 2],
    source_totals: [usize; 2],
    /// Cells of the smallest box around both maps.
    covered: usize,
}

impl Overlaid {
    pub(crate) fn new(
        target: &OccupancyGrid,
        source: &OccupancyGrid,
        target_from_source: &Se2,
        thresholds: &ClassThresholds,
    ) -> Result<Self, RadonError> {
        let lattice = target.frame();
        let far = [source.width() as f64, source.height() as f64];
        let corners = [[0.0, 0.0], [far[0], 0.0], [0.0, far[1]], far].map(|[x, y]| {
            let corner = source.frame().point_from_cells([x, y].into());
            lattice.lattice_cell(*target_from_source * corner)
        });
        let low = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).min().unwrap_or(0));
        let high = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).max().unwrap_or(0));
        let [width, height] = [0, 1].map(|axis| {
            usize::try_from(high[axis].saturating_sub(low[axis]).saturating_add(1)).unwrap_or(0)
        });
        let classes = |map: &OccupancyGrid| map.cells().map(|&cell| thresholds.classify(cell));
        let source_classes = warp_nearest(
            &classes(source),
            source.frame(),
            &lattice.shifted(low[0], low[1]),
            (width, height),
            target_from_source,
            CellClass::Unknown,
        )?;
        let target_classes = classes(target);
        let [columns, rows] = [(0, target.width()), (1, target.height())].map(|(axis, size)| {
            let size = i64::try_from(size).unwrap_or(i64::MAX);
            usize::try_from(high[axis].saturating_add(1).max(size).saturating_sub(low[axis].min(0)))
                .unwrap_or(usize::MAX)
        });
        Ok(Self {
            target: Planes::new(&target_classes, 0, target.width()),
            target_totals: totals(&target_classes),
            source_totals: totals(&source_classes),
            source: source_classes,
            corner: low,
            covered: columns.saturating_mul(rows),
        })
    }

    /// Counts at every shift of at most `radius` cells an axis: rows of the result are shifts in
    /// y, columns shifts in x, both ascending.
    pub(crate) fn counts(&self, radius: usize) -> Result<Grid<JointCounts>, RadonError> {
        let side = 2 * radius + 1;
        let mut counts = Grid::filled(side, side, JointCounts::default())?;
        let reach = i64::try_from(radius).unwrap_or(i64::MAX);
        for column in 0..side {
            let dx = column as i64 - reach;
            let width = self.target.width;
            let source = Planes::new(&self.source, self.corner[0].saturating_add(dx), width);
            for row in 0..side {
                let dy = row as i64 - reach;
                let met = self.target.met_by(&source, self.corner[1].saturating_add(dy));
                counts.cells_mut()[row * side + column] = self.joint(met);
            }
        }
        Ok(counts)
    }

    fn joint(
        &self,
        [both_occupied, both_free, occupied_free, free_occupied]: [usize; 4],
    ) -> JointCounts {
        let ([target_occupied, target_free], [source_occupied, source_free]) =
            (self.target_totals, self.source_totals);
        let mut counts = JointCounts {
            both_occupied,
            both_free,
            occupied_free,
            free_occupied,
            occupied_unknown: target_occupied - both_occupied - occupied_free,
            free_unknown: target_free - both_free - free_occupied,
            unknown_occupied: source_occupied - both_occupied - free_occupied,
            unknown_free: source_free - both_free - occupied_free,
            both_unknown: 0,
        };
        let known = counts.agreement() + counts.disagreement() + counts.known_in_one();
        counts.both_unknown = self.covered.saturating_sub(known);
        counts
    }
}

/// Occupied and free cells.
fn totals(classes: &Grid<CellClass>) -> [usize; 2] {
    [CellClass::Occupied, CellClass::Free]
        .map(|class| classes.cells().iter().filter(|&&cell| cell == class).count())
}

/// Classes as bits, 64 cells of a row in a word.
struct Planes {
    width: usize,
    words: usize,
    /// Occupied and free.
    rows: Vec<[u64; 2]>,
}

impl Planes {
    /// The first column of `classes` goes to column `offset` of `width`; the rest is cut off.
    fn new(classes: &Grid<CellClass>, offset: i64, width: usize) -> Self {
        let words = width.div_ceil(64);
        let mut rows = vec![[0, 0]; words * classes.height()];
        let skip = usize::try_from(offset.saturating_neg()).unwrap_or(0);
        let first = usize::try_from(offset).unwrap_or(0);
        for (output, cells) in rows.chunks_exact_mut(words).zip(classes.rows()) {
            for (column, &class) in (first..width).zip(cells.iter().skip(skip)) {
                let bit = 1_u64 << (column % 64);
                match class {
                    CellClass::Occupied => output[column / 64][0] |= bit,
                    CellClass::Free => output[column / 64][1] |= bit,
                    _ => {}
                }
            }
        }
        Self { width, words, rows }
    }

    /// Cells that are occupied in both, free in both, occupied here and free there, and the
    /// reverse, where the first row of `other` is row `offset` of this.
    fn met_by(&self, other: &Self, offset: i64) -> [usize; 4] {
        let skip = usize::try_from(offset.saturating_neg()).unwrap_or(0);
        let first = usize::try_from(offset).unwrap_or(0);
        let here = self.rows.iter().skip(first.saturating_mul(self.words));
        let there = other.rows.iter().skip(skip.saturating_mul(self.words));
        let mut met = [0_u64; 4];
        for ([occupied, free], [other_occupied, other_free]) in here.zip(there) {
            // Most words meet nothing.
            if (occupied | free) & (other_occupied | other_free) == 0 {
                continue;
            }
            let bits = [
                occupied & other_occupied,
                free & other_free,
                occupied & other_free,
                free & other_occupied,
            ];
            for (sum, bits) in met.iter_mut().zip(bits) {
                *sum += u64::from(bits.count_ones());
            }
        }
        met.map(|count| usize::try_from(count).unwrap_or(usize::MAX))
    }
}
