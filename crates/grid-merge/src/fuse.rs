//! What several maps say of a cell, made one.

use std::ops::Range;

use ogm_core::{
    Cancelled, ClassThresholds, Grid, GridError, GridFrame, Occupancy, Progress, Steps,
};

use crate::FusionRule;

use crate::keep_walls::KeepWalls;
use crate::mask::CellMask;
use crate::placed::PlacedMap;
use crate::regions::RegionFinder;
use crate::rows::{Reach, Said};
use crate::verdict::{Counts, Overlap, PairVerdicts, SAID_FREE, SAID_OCCUPIED, Tables};
use crate::walls::Walls;

/// Rows that are read of every map at a time.
const BAND: usize = 128;

/// A fused grid and what there was to compare.
pub(crate) struct Fused {
    pub(crate) cells: Grid<Occupancy>,
    pub(crate) conflicts: CellMask,
    pub(crate) regions: RegionFinder,
    /// Known in two maps or more.
    pub(crate) compared: usize,
}

impl Fused {
    /// All unknown.
    pub(crate) fn blank(size: (usize, usize)) -> Result<Self, GridError> {
        Ok(Self {
            cells: Grid::filled(size.0, size.1, Occupancy::UNKNOWN)?,
            conflicts: CellMask::empty(size),
            regions: RegionFinder::new(),
            compared: 0,
        })
    }

    /// Adds what the maps say to a blank; all must lie inside. A band of rows at a time, so that
    /// what is between the maps and the output stays small.
    pub(crate) fn fuse(
        &mut self,
        reaches: &[Reach<'_>],
        rule: &Rule<'_>,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let (width, height) = (self.cells.width(), self.cells.height());
        let halo = match rule {
            Rule::KeepWalls(keep) => keep.halo,
            Rule::ByCell(..) => 0,
        };
        let mut by_cell = ByCell::new(width);
        let mut walls = Walls::none();
        let mut said: Vec<Said> = reaches.iter().map(|_| Said::default()).collect();
        let done = Steps::new(progress, height);
        for (band, output) in self.cells.cells_mut().chunks_mut(BAND * width).enumerate() {
            let first = band * BAND;
            let last = first + output.len() / width;
            let around = first.saturating_sub(halo)..(last + halo).min(height);
            for (reach, said) in reaches.iter().zip(&mut said) {
                reach.read(&around, said);
            }
            if let Rule::KeepWalls(keep) = rule {
                walls.clear(around, width);
                keep.place(reaches, &mut said, &mut walls, progress)?;
            }
            for (row, cells) in (first..last).zip(output.chunks_exact_mut(width)) {
                done.step()?;
                let (conflicts, regions) = (&mut self.conflicts, &mut self.regions);
                let contradicted = |column, occupied: &[usize], free: &[usize]| {
                    conflicts.insert(row, column);
                    regions.add(row, column, occupied, free);
                };
                self.compared += match rule {
                    Rule::KeepWalls(keep) => keep.fuse_row(&said, &walls, row, cells, contradicted),
                    Rule::ByCell(rule, tables) => {
                        by_cell.fuse_row((*rule, tables), &said, (row, cells), contradicted)
                    }
                };
            }
        }
        Ok(())
    }
}

/// How it is decided what a cell becomes.
pub(crate) enum Rule<'a> {
    /// By the walls around it.
    KeepWalls(Box<KeepWalls<'a>>),
    /// By what is said of it alone.
    ByCell(FusionRule, Box<Tables>),
}

impl<'a> Rule<'a> {
    /// For `maps` on the output whose cell (0, 0) is that of `frame`.
    pub(crate) fn new(
        rule: FusionRule,
        maps: &'a [PlacedMap<'a>],
        frame: GridFrame,
        thresholds: &ClassThresholds,
    ) -> Self {
        let tables = Tables::new(thresholds);
        match rule {
            FusionRule::KeepWalls => Self::KeepWalls(Box::new(KeepWalls::new(maps, frame, tables))),
            rule => Self::ByCell(rule, Box::new(tables)),
        }
    }
}

/// What is gathered of a row by the rules that ask no cell but the one.
struct ByCell {
    pairs: Option<PairVerdicts>,
    conflicts: Vec<bool>,
    overlaps: Vec<Overlap>,
}

impl ByCell {
    fn new(width: usize) -> Self {
        let overlaps = vec![Overlap::default(); width];
        Self { pairs: None, conflicts: vec![false; width], overlaps }
    }

    fn fuse_row(
        &mut self,
        (rule, tables): (FusionRule, &Tables),
        said: &[Said],
        (row, cells): (usize, &mut [Occupancy]),
        mut contradicted: impl FnMut(usize, &[usize], &[usize]),
    ) -> usize {
        let covering: Vec<(usize, Range<usize>, &[Occupancy])> = said
            .iter()
            .enumerate()
            .map(|(map, said)| (map, said.columns.clone(), said.row(row)))
            .filter(|(_, _, cells)| !cells.is_empty())
            .collect();
        let Some(((_, columns, first), others)) = covering.split_first() else {
            return 0;
        };
        cells[columns.clone()].copy_from_slice(first);
        let Self { pairs, conflicts, overlaps } = self;
        let counts = match others {
            [] => Counts::default(),
            [(_, columns, said)] => {
                let pairs = pairs.get_or_insert_with(|| PairVerdicts::new(tables, rule));
                let columns = columns.clone();
                pairs.apply(said, &mut cells[columns.clone()], &mut conflicts[columns])
            }
            _ => {
                for (_, columns, said) in others {
                    let columns = columns.clone();
                    tables.accumulate(said, &mut cells[columns.clone()], &mut overlaps[columns]);
                }
                tables.resolve(rule, cells, conflicts, overlaps)
            }
        };
        if counts.conflicts > 0 {
            for (column, conflict) in conflicts.iter_mut().enumerate() {
                if std::mem::take(conflict) {
                    let saying = |class| {
                        let maps = covering.iter().filter(|(_, columns, cells)| {
                            let cell =
                                columns.contains(&column).then(|| cells[column - columns.start]);
                            cell.is_some_and(|cell| tables.class(cell) == class)
                        });
                        maps.map(|&(map, ..)| map).collect::<Vec<_>>()
                    };
                    contradicted(column, &saying(SAID_OCCUPIED), &saying(SAID_FREE));
                }
            }
        }
        counts.compared
    }
}

#[cfg(test)]
mod tests {
    use super::{Fused, Rule};
    use crate::FusionRule;
    use crate::placed::PlacedMap;
    use crate::rows::{Reach, ReachCells};
    use ogm_core::{CellIndex, ClassThresholds, Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
    use proptest::prelude::{ProptestConfig, any, prop, prop_assert_eq, proptest};
    use std::borrow::Cow;

    fn fuse_bytes(rule: FusionRule, layers: &[Vec<u8>]) -> Fused {
        let frame = GridFrame::new(1.0, Se2::identity()).unwrap();
        let maps: Vec<_> = layers
            .iter()
            .map(|bytes| {
                let cells = bytes.iter().copied().map(Occupancy::from_byte).collect();
                OccupancyGrid::new(frame, Grid::new(bytes.len(), 1, cells).unwrap())
            })
            .collect();
        let placed: Vec<_> = maps.iter().map(|map| PlacedMap::new(map, Se2::identity())).collect();
        let reaches: Vec<_> = maps
            .iter()
            .map(|map| Reach {
                columns: 0..map.width(),
                rows: 0..1,
                cells: ReachCells::Laid(Cow::Borrowed(map.cells())),
            })
            .collect();
        let mut fused = Fused::blank((maps[0].width(), 1)).unwrap();
        let rule = Rule::new(rule, &placed, frame, &ClassThresholds::default());
        fused.fuse(&reaches, &rule, &()).unwrap();
        fused
    }

    fn fuse_one(rule: FusionRule, probabilities: &[f64]) -> Fused {
        let layers: Vec<_> =
            probabilities.iter().map(|&p| vec![Occupancy::from_probability(p).byte()]).collect();
        fuse_bytes(rule, &layers)
    }

    fn bytes(fused: &Fused) -> Vec<u8> {
        fused.cells.cells().iter().map(|cell| cell.byte()).collect()
    }

    const RULES: [FusionRule; 6] = [
        FusionRule::LogOdds,
        FusionRule::MaxConfidence,
        FusionRule::First,
        FusionRule::Last,
        FusionRule::Occupied,
        FusionRule::KeepWalls,
    ];
    const BY_CELL: &[FusionRule] = RULES.split_at(5).0;

    #[test]
    fn each_rule_gives_its_value() {
        for (&rule, expected) in BY_CELL.iter().zip([0.631_579, 0.8, 0.8, 0.3, 0.8]) {
            let fused = fuse_one(rule, &[0.8, 0.3]);
            let p = fused.cells.cells()[0].probability().unwrap();
            assert!((p - expected).abs() <= 1.0 / 254.0, "{rule:?}: {p}");
            assert_eq!((fused.conflicts.count(), fused.compared), (1, 1));
        }
    }

    #[test]
    fn equal_and_opposite_evidence_is_a_known_half_and_a_conflict() {
        for rule in [FusionRule::LogOdds, FusionRule::MaxConfidence] {
            let fused = fuse_one(rule, &[0.9, 0.1]);
            assert_eq!(fused.cells.cells()[0], Occupancy::from_probability(0.5));
            assert!(fused.conflicts.contains(CellIndex { column: 0, row: 0 }));
        }
    }

    #[test]
    fn evidence_is_clamped_once_and_not_on_the_way() {
        let fused = fuse_one(FusionRule::LogOdds, &[1.0, 1.0, 0.0, 0.0]);
        assert_eq!(fused.cells.cells()[0], Occupancy::from_probability(0.5));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]

        #[test]
        fn order_of_the_maps_changes_nothing(
            columns in prop::collection::vec(any::<[u8; 4]>(), 1..40), turn in 0_usize..4,
        ) {
            let layers: Vec<Vec<u8>> =
                (0..4).map(|map| columns.iter().map(|column| column[map]).collect()).collect();
            let mut reordered = layers.clone();
            reordered.rotate_left(turn);
            reordered.swap(0, 1);
            for rule in [FusionRule::LogOdds, FusionRule::MaxConfidence, FusionRule::Occupied] {
                let (a, b) = (fuse_bytes(rule, &layers), fuse_bytes(rule, &reordered));
                prop_assert_eq!(bytes(&a), bytes(&b));
                prop_assert_eq!(a.conflicts, b.conflicts);
                prop_assert_eq!(a.compared, b.compared);
            }
        }

        #[test]
        fn unknown_is_neutral(pairs in prop::collection::vec(any::<[u8; 2]>(), 200)) {
            let one: Vec<u8> = pairs.iter().map(|pair| pair[0]).collect();
            let other: Vec<u8> = pairs.iter().map(|pair| pair[1]).collect();
            let unknown = vec![u8::MAX; pairs.len()];
            for rule in RULES {
                for layers in [[one.clone(), unknown.clone()], [unknown.clone(), one.clone()]] {
                    let fused = fuse_bytes(rule, &layers);
                    prop_assert_eq!(bytes(&fused), one.clone());
                    prop_assert_eq!((fused.compared, fused.conflicts.count()), (0, 0));
                }
                let two = fuse_bytes(rule, &[one.clone(), other.clone()]);
                let three = fuse_bytes(rule, &[one.clone(), unknown.clone(), other.clone()]);
                prop_assert_eq!(bytes(&two), bytes(&three));
                prop_assert_eq!(two.conflicts, three.conflicts);
                prop_assert_eq!(two.compared, three.compared);
            }
        }
    }
}
