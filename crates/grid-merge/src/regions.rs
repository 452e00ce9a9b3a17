//! The places where maps contradict each other.

use std::ops::Range;

use nalgebra::{Point2, Vector2};
use ogm_core::GridFrame;

/// Cells this far apart or nearer, in columns and in rows, are of one region: walls on a lattice
/// have gaps of a cell.
const LINK: usize = 2;

/// The most regions that are kept; the largest.
const MOST_REGIONS: usize = 1000;

/// Regions that are followed at a time before those that have ended are put away.
const FOLLOWED: usize = 1 << 16;

/// A place where maps contradict each other: a door that moved, a person, a map that is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct ConflictRegion {
    /// Mean of its cells' centres, in the frame of the output, metres.
    pub centre: Point2<f64>,
    /// Extent along the axes of the output, metres.
    pub size: Vector2<f64>,
    /// Its cells.
    pub cells: usize,
    /// The maps that say occupied somewhere in it, by their place in what was handed in.
    pub occupied: Vec<usize>,
    /// Those that say free.
    pub free: Vec<usize>,
}

/// What is known of a region before its last row.
#[derive(Debug, Clone, Default)]
struct Gathered {
    cells: usize,
    columns_sum: usize,
    rows_sum: usize,
    columns: Range<usize>,
    rows: Range<usize>,
    occupied: Vec<usize>,
    free: Vec<usize>,
}

impl Gathered {
    fn add(&mut self, other: Self) {
        if self.cells == 0 {
            *self = other;
            return;
        }
        self.cells += other.cells;
        self.columns_sum += other.columns_sum;
        self.rows_sum += other.rows_sum;
        self.columns = around(&self.columns, &other.columns);
        self.rows = around(&self.rows, &other.rows);
        insert_all(&mut self.occupied, &other.occupied);
        insert_all(&mut self.free, &other.free);
    }

    fn region(self, frame: &GridFrame) -> ConflictRegion {
        let mean = |sum: usize| sum as f64 / self.cells as f64 + 0.5;
        let cells = Vector2::new(self.columns.len() as f64, self.rows.len() as f64);
        ConflictRegion {
            centre: frame
                .point_from_cells(Point2::new(mean(self.columns_sum), mean(self.rows_sum))),
            size: cells * frame.resolution(),
            cells: self.cells,
            occupied: self.occupied,
            free: self.free,
        }
    }
}

fn around(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}

fn insert_all(set: &mut Vec<usize>, others: &[usize]) {
    for &other in others {
        if let Err(at) = set.binary_search(&other) {
            set.insert(at, other);
        }
    }
}

/// Regions of cells that come row by row, lowest first, each row from the left; only the last rows
/// are followed, so that memory does not grow with the grid.
pub(crate) struct RegionFinder {
    /// Of the row that is coming in, and the [`LINK`] before it.
    runs: [Vec<Run>; LINK + 1],
    row: usize,
    parents: Vec<usize>,
    gathered: Vec<Gathered>,
    ended: Vec<Gathered>,
    ended_count: usize,
}

struct Run {
    columns: Range<usize>,
    region: usize,
}

impl RegionFinder {
    pub(crate) fn new() -> Self {
        Self {
            runs: Default::default(),
            row: 0,
            parents: Vec::new(),
            gathered: Vec::new(),
            ended: Vec::new(),
            ended_count: 0,
        }
    }

    pub(crate) fn add(&mut self, row: usize, column: usize, occupied: &[usize], free: &[usize]) {
        while self.row < row {
            self.end_row();
        }
        let region = match self.runs[0].last_mut() {
            Some(run) if column < run.columns.end + LINK => {
                run.columns.end = column + 1;
                run.region
            }
            _ => {
                let region = self.parents.len();
                self.parents.push(region);
                self.gathered.push(Gathered::default());
                self.runs[0].push(Run { columns: column..column + 1, region });
                region
            }
        };
        let gathered = &mut self.gathered[region];
        if gathered.cells == 0 {
            gathered.columns = column..column + 1;
            gathered.rows = row..row + 1;
        }
        gathered.cells += 1;
        gathered.columns_sum += column;
        gathered.rows_sum += row;
        gathered.columns.end = column + 1;
        insert_all(&mut gathered.occupied, occupied);
        insert_all(&mut gathered.free, free);
    }

    fn end_row(&mut self) {
        let [current, before @ ..] = &self.runs;
        let mut links = Vec::new();
        for earlier in before {
            let mut next = 0;
            for run in current {
                let reach = run.columns.start.saturating_sub(LINK)..run.columns.end + LINK;
                while earlier.get(next).is_some_and(|other| other.columns.end <= reach.start) {
                    next += 1;
                }
                let others = earlier[next..].iter();
                let near = others.take_while(|other| other.columns.start < reach.end);
                links.extend(near.map(|other| (run.region, other.region)));
            }
        }
        for (a, b) in links {
            let (a, b) = (self.root(a), self.root(b));
            if a != b {
                let joined = std::mem::take(&mut self.gathered[a.max(b)]);
                self.parents[a.max(b)] = a.min(b);
                self.gathered[a.min(b)].add(joined);
            }
        }
        self.runs.rotate_right(1);
        self.runs[0].clear();
        self.row += 1;
        if self.parents.len() > FOLLOWED {
            self.put_ended_away();
        }
    }

    fn root(&self, mut region: usize) -> usize {
        while self.parents[region] != region {
            region = self.parents[region];
        }
        region
    }

    /// Keeps following the regions of the last rows only.
    fn put_ended_away(&mut self) {
        let roots: Vec<Vec<usize>> = self
            .runs
            .iter()
            .map(|runs| runs.iter().map(|run| self.root(run.region)).collect())
            .collect();
        let mut followed: Vec<usize> = roots.iter().flatten().copied().collect();
        followed.sort_unstable();
        followed.dedup();
        for (runs, roots) in self.runs.iter_mut().zip(roots) {
            for (run, root) in runs.iter_mut().zip(roots) {
                run.region = followed.partition_point(|&region| region < root);
            }
        }
        let gathered = followed.iter().map(|&root| std::mem::take(&mut self.gathered[root]));
        let gathered = gathered.collect();
        let ended = std::mem::replace(&mut self.gathered, gathered);
        self.parents = (0..self.gathered.len()).collect();
        let ended = ended.into_iter().filter(|region| region.cells > 0);
        let before = self.ended.len();
        self.ended.extend(ended);
        self.ended_count += self.ended.len() - before;
        // Stable: of equal ones the lowest stay.
        self.ended.sort_by_key(|region| std::cmp::Reverse(region.cells));
        self.ended.truncate(MOST_REGIONS);
    }

    /// The largest regions, largest first, and how many there are.
    pub(crate) fn finish(mut self, frame: &GridFrame) -> (Vec<ConflictRegion>, usize) {
        self.end_row();
        self.runs = Default::default();
        self.put_ended_away();
        let regions = self.ended.into_iter().map(|region| region.region(frame));
        (regions.collect(), self.ended_count)
    }
}

#[cfg(test)]
mod tests {
    use super::{LINK, RegionFinder};
    use crate::mask::CellMask;
    use ogm_core::{CellIndex, GridFrame, Se2};
    use proptest::prelude::{prop, prop_assert_eq, proptest};

    fn frame() -> GridFrame {
        GridFrame::new(0.1, Se2::identity()).unwrap()
    }

    #[test]
    fn a_region_says_where_it_is_and_who_says_what() {
        let mut finder = RegionFinder::new();
        finder.add(3, 10, &[0], &[2]);
        finder.add(4, 11, &[1], &[2]);
        finder.add(9, 2, &[1], &[0]);
        let (regions, count) = finder.finish(&frame());
        assert_eq!((regions.len(), count), (2, 2));
        let door = &regions[0];
        assert!((door.centre - nalgebra::Point2::new(1.1, 0.4)).norm() < 1e-12);
        assert!((door.size - nalgebra::Vector2::new(0.2, 0.2)).norm() < 1e-12);
        assert_eq!((door.cells, &door.occupied[..], &door.free[..]), (2, &[0, 1][..], &[2][..]));
    }

    proptest! {
        #[test]
        fn regions_are_those_of_flooding(
            bits in prop::collection::vec(prop::bool::weighted(0.15), 18 * 14),
        ) {
            let (width, height) = (18, 14);
            let mut finder = RegionFinder::new();
            let mut mask = CellMask::empty((width, height));
            for (at, _) in bits.iter().enumerate().filter(|&(_, &set)| set) {
                finder.add(at / width, at % width, &[0], &[1]);
                mask.insert(at / width, at % width);
            }
            let (regions, count) = finder.finish(&frame());
            let mut sizes: Vec<usize> = regions.iter().map(|region| region.cells).collect();
            sizes.sort_unstable();

            let mut left: Vec<CellIndex> = mask.iter().collect();
            prop_assert_eq!(left.len(), mask.count());
            let grid = mask.to_grid();
            prop_assert_eq!(grid.cells(), &bits[..]);
            let mut expected = Vec::new();
            while let Some(seed) = left.pop() {
                let mut region = vec![seed];
                let mut next = 0;
                while let Some(&at) = region.get(next) {
                    next += 1;
                    let is_near = |other: &CellIndex| {
                        other.column.abs_diff(at.column) <= LINK && other.row.abs_diff(at.row) <= LINK
                    };
                    region.extend(left.extract_if(.., |other| is_near(other)));
                }
                expected.push(region.len());
            }
            expected.sort_unstable();
            prop_assert_eq!(count, expected.len());
            prop_assert_eq!(sizes, expected);
        }
    }
}
