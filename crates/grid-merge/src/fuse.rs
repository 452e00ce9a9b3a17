//! What several maps say of a cell, made one.

use ogm_core::{Cancelled, ClassThresholds, Grid, GridError, Occupancy, Progress, Steps};

use crate::FusionRule;
use crate::mapping::Layer;
use crate::verdict::{Counts, Overlap, PairVerdicts, Tables};

/// A fused grid and what there was to compare.
pub(crate) struct Fused {
    pub(crate) cells: Grid<Occupancy>,
    /// Said to be occupied by one layer and free by another.
    pub(crate) conflicts: Grid<bool>,
    pub(crate) conflict_count: usize,
    /// Known in two layers or more.
    pub(crate) compared: usize,
}

impl Fused {
    /// All unknown.
    pub(crate) fn blank((width, height): (usize, usize)) -> Result<Self, GridError> {
        Ok(Self {
            cells: Grid::filled(width, height, Occupancy::UNKNOWN)?,
            conflicts: Grid::filled(width, height, false)?,
            conflict_count: 0,
            compared: 0,
        })
    }

    /// Adds what `layers` say to a blank; all must lie inside. Row by row, so that only one row of
    /// sums exists at a time.
    pub(crate) fn fuse(
        &mut self,
        layers: &[Layer<'_, Occupancy>],
        rule: FusionRule,
        thresholds: &ClassThresholds,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let width = self.cells.width();
        let tables = Tables::new(thresholds);
        let mut pairs = None;
        let mut overlaps = vec![Overlap::default(); width];
        let mut covering = Vec::with_capacity(layers.len());
        let done = Steps::new(progress, self.cells.height());
        let rows = self.cells.cells_mut().chunks_exact_mut(width);
        let rows = rows.zip(self.conflicts.cells_mut().chunks_exact_mut(width));
        for (row, (cells, conflicts)) in rows.enumerate() {
            done.step()?;
            covering.clear();
            covering.extend(layers.iter().filter_map(|layer| {
                let said = layer.output_row(row)?;
                Some((layer.column..layer.column + said.len(), said))
            }));
            let Some(((columns, said), others)) = covering.split_first() else {
                continue;
            };
            cells[columns.clone()].copy_from_slice(said);
            let counts = match others {
                [] => Counts::default(),
                [(columns, said)] => {
                    let columns = columns.clone();
                    let pairs = pairs.get_or_insert_with(|| PairVerdicts::new(&tables, rule));
                    pairs.apply(said, &mut cells[columns.clone()], &mut conflicts[columns])
                }
                _ => {
                    for (columns, said) in others {
                        let columns = columns.clone();
                        tables.accumulate(
                            said,
                            &mut cells[columns.clone()],
                            &mut overlaps[columns],
                        );
                    }
                    tables.resolve(rule, cells, conflicts, &mut overlaps)
                }
            };
            self.compared += counts.compared;
            self.conflict_count += counts.conflicts;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Fused;
    use crate::FusionRule;
    use crate::mapping::Layer;
    use ogm_core::{ClassThresholds, Grid, Occupancy};
    use proptest::prelude::{ProptestConfig, any, prop, prop_assert_eq, proptest};
    use std::borrow::Cow;

    fn fuse_bytes(rule: FusionRule, layers: &[Vec<u8>]) -> Fused {
        let layers: Vec<_> = layers
            .iter()
            .map(|bytes| {
                let cells = bytes.iter().copied().map(Occupancy::from_byte).collect();
                Layer {
                    column: 0,
                    row: 0,
                    cells: Cow::Owned(Grid::new(bytes.len(), 1, cells).unwrap()),
                }
            })
            .collect();
        let mut fused = Fused::blank((layers[0].cells.width(), 1)).unwrap();
        fused.fuse(&layers, rule, &ClassThresholds::default(), &()).unwrap();
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

    const RULES: [FusionRule; 4] = [
        FusionRule::LogOddsSum,
        FusionRule::MaxConfidence,
        FusionRule::PreferFirst,
        FusionRule::Overwrite,
    ];

    #[test]
    fn each_rule_gives_its_value() {
        for (rule, expected) in RULES.into_iter().zip([0.631_579, 0.8, 0.8, 0.3]) {
            let fused = fuse_one(rule, &[0.8, 0.3]);
            let p = fused.cells.cells()[0].probability().unwrap();
            assert!((p - expected).abs() <= 1.0 / 254.0, "{rule:?}: {p}");
            assert_eq!((fused.conflict_count, fused.compared), (1, 1));
        }
    }

    #[test]
    fn equal_and_opposite_evidence_is_a_known_half_and_a_conflict() {
        for rule in [FusionRule::LogOddsSum, FusionRule::MaxConfidence] {
            let fused = fuse_one(rule, &[0.9, 0.1]);
            assert_eq!(fused.cells.cells()[0], Occupancy::from_probability(0.5));
            assert_eq!(fused.conflicts.cells(), [true]);
        }
    }

    #[test]
    fn evidence_is_clamped_once_and_not_on_the_way() {
        let fused = fuse_one(FusionRule::LogOddsSum, &[1.0, 1.0, 0.0, 0.0]);
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
            for rule in [FusionRule::LogOddsSum, FusionRule::MaxConfidence] {
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
                    prop_assert_eq!((fused.compared, fused.conflict_count), (0, 0));
                }
                let two = fuse_bytes(rule, &[one.clone(), other.clone()]);
                let three = fuse_bytes(rule, &[one.clone(), unknown.clone(), other.clone()]);
                prop_assert_eq!(bytes(&two), bytes(&three));
                prop_assert_eq!(two.conflicts, three.conflicts);
                let counts = (three.compared, three.conflict_count);
                prop_assert_eq!((two.compared, two.conflict_count), counts);
            }
        }
    }
}
