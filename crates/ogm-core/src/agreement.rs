//! How far two maps of one lattice say the same.

use crate::{CellClass, ClassThresholds, GridError, OccupancyGrid};

/// Counts of the cells that two maps on one lattice both know.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Agreement {
    /// Occupied in both.
    pub both_occupied: usize,
    /// Free in both.
    pub both_free: usize,
    /// Occupied in one and free in the other.
    pub conflicts: usize,
    /// Known in both, whatever they say.
    pub known_in_both: usize,
}

impl Agreement {
    /// Compares `a` and `b` cell by cell; they must have the same size and resolution, and it is
    /// the caller's word that cell (0, 0) is the same place.
    ///
    /// # Errors
    /// [`GridError::ResolutionMismatch`] if size or resolution differ.
    pub fn between(
        a: &OccupancyGrid,
        b: &OccupancyGrid,
        thresholds: &ClassThresholds,
    ) -> Result<Self, GridError> {
        let same_size = a.width() == b.width() && a.height() == b.height();
        if !same_size || !a.frame().same_resolution(b.frame()) {
            return Err(GridError::ResolutionMismatch {
                a_width: a.width(),
                a_height: a.height(),
                a_resolution: a.frame().resolution(),
                b_width: b.width(),
                b_height: b.height(),
                b_resolution: b.frame().resolution(),
            });
        }
        let mut counts = Self::default();
        for (&in_a, &in_b) in a.cells().cells().iter().zip(b.cells().cells()) {
            if !(in_a.is_known() && in_b.is_known()) {
                continue;
            }
            counts.known_in_both += 1;
            match (thresholds.classify(in_a), thresholds.classify(in_b)) {
                (CellClass::Occupied, CellClass::Occupied) => counts.both_occupied += 1,
                (CellClass::Free, CellClass::Free) => counts.both_free += 1,
                (CellClass::Occupied, CellClass::Free) | (CellClass::Free, CellClass::Occupied) => {
                    counts.conflicts += 1;
                }
                _ => {}
            }
        }
        Ok(counts)
    }

    /// Share of the decided common cells that agree, or `None` if there is none.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        let agreeing = self.both_occupied + self.both_free;
        let decided = agreeing + self.conflicts;
        (decided > 0).then(|| agreeing as f64 / decided as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::Agreement;
    use crate::{ClassThresholds, GridError, GridFrame, OccupancyGrid, Se2};

    fn map(resolution: f64, picture: &str) -> OccupancyGrid {
        let frame = GridFrame::new(resolution, Se2::identity()).unwrap();
        OccupancyGrid::from_ascii(frame, picture).unwrap()
    }

    #[test]
    fn unknown_cells_neither_agree_nor_conflict() {
        let (a, b) = (map(1.0, "##.?"), map(1.0, "#..."));
        let agreement = Agreement::between(&a, &b, &ClassThresholds::default()).unwrap();
        let expected = Agreement { both_occupied: 1, both_free: 1, conflicts: 1, known_in_both: 3 };
        assert_eq!(agreement, expected);
        assert_eq!(agreement.share(), Some(2.0 / 3.0));

        let blank = Agreement::between(&a, &map(1.0, "????"), &ClassThresholds::default()).unwrap();
        assert_eq!(blank.share(), None);
    }

    #[test]
    fn maps_of_another_resolution_or_size_are_an_error() {
        for other in [map(0.5, "##.?"), map(1.0, "##.")] {
            let counts = Agreement::between(&map(1.0, "##.?"), &other, &ClassThresholds::default());
            assert!(matches!(counts, Err(GridError::ResolutionMismatch { .. })));
        }
    }
}
