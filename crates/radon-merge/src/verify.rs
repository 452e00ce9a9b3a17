//! Whether a transform is right, scored by cells, walls and entropy.

use nalgebra::Point2;
use ogm_core::{
    CellIndex, ClassThresholds, Grid, OccupancyGrid, Outcome, ParameterError, Refusal, Se2,
    l2_distance_sq, require,
};

use crate::{JointCounts, TranslationWindow};

/// What a transform must show to be accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerificationParams {
    /// Least verification index V, percent. The paper accepts what is "close to 100 %".
    pub min_index: f64,
    /// Least area on which the maps agree, m²: little free space agrees with anything. 5 m² are
    /// 2000 cells of 0.05 m.
    pub min_area: f64,
    /// Least share of walls that lie on a wall of the other map, of those on its known cells;
    /// in either direction. Free space outweighs walls in V: a wrong pose can have 97 % of V and
    /// 0.4 of this; right ones have 0.95 and more of it on simulated maps.
    pub min_wall_share: f64,
    /// Least length of wall that both maps show, metres, counted in cells.
    pub min_wall_length: f64,
    /// Most cells, along an axis, between the best similarity and the least entropy.
    pub max_entropy_offset: u64,
    /// Largest share of the walls that still coincide four cells away in any direction: along a
    /// bare corridor all do, and the translation is anybody's guess. 0.5 to 0.8 in buildings.
    pub max_slide: f64,
}

impl Default for VerificationParams {
    fn default() -> Self {
        Self {
            min_index: 95.0,
            min_area: 5.0,
            min_wall_share: 0.9,
            min_wall_length: 6.0,
            max_entropy_offset: 1,
            max_slide: 0.85,
        }
    }
}

impl VerificationParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let index = self.min_index;
        require((0.0..=100.0).contains(&index), "verification.min_index", "0 to 100 %", index)?;
        let share = self.min_wall_share;
        require((0.0..=1.0).contains(&share), "verification.min_wall_share", "0 to 1", share)?;
        let area = self.min_area;
        require(area >= 0.0, "verification.min_area", "at least 0", area)?;
        let length = self.min_wall_length;
        require(length >= 0.0, "verification.min_wall_length", "at least 0", length)?;
        let slide = self.max_slide;
        require(slide >= 0.0, "verification.max_slide", "at least 0", slide)
    }
}

/// V of Eq. 20: agreeing cells in a hundred that agree or disagree; `None` if there are none.
#[must_use]
pub fn verification_index(agreement: usize, disagreement: usize) -> Option<f64> {
    let compared = agreement + disagreement;
    (compared > 0).then(|| 100.0 * agreement as f64 / compared as f64)
}

/// What two maps say about a transform between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verification {
    /// Class counts at the transform.
    pub counts: JointCounts,
    /// V, percent; `None` where the maps know no cell in common.
    pub index: Option<f64>,
    /// Walls of the source on the target.
    pub source_walls: WallShare,
    /// Walls of the target on the source.
    pub target_walls: WallShare,
    /// Cells between the shift of best similarity and that of least entropy.
    pub entropy_offset: u64,
    /// See [`TranslationWindow::slide`].
    pub slide: f64,
    /// Metres a cell.
    pub resolution: f64,
}

/// Walls of one map that lie on walls of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WallShare {
    /// Occupied cells within one cell, straight or diagonal, of an occupied cell of the other map.
    pub met: usize,
    /// Occupied cells on known cells of the other map.
    pub compared: usize,
}

impl WallShare {
    /// Share of the compared cells that meet a wall; 0 if none was compared.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.compared > 0 { self.met as f64 / self.compared as f64 } else { 0.0 }
    }
}

/// Scores the tuned transform of `window` (Saeedi et al., section II.I, with the shares of walls
/// added).
///
/// `Refused` if one of the maps has no occupied cell.
pub fn verify(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    window: &TranslationWindow,
    thresholds: &ClassThresholds,
) -> Outcome<Verification> {
    let fields = [target, source].map(|map| WallField::new(map, thresholds));
    let [Some(target), Some(source)] = fields else {
        return Outcome::Refused(Refusal::TooLittleStructure { have: 0, need: 1 });
    };
    Outcome::Found(verify_prepared(&target, &source, window))
}

pub(crate) fn verify_prepared(
    target: &WallField<'_>,
    source: &WallField<'_>,
    window: &TranslationWindow,
) -> Verification {
    let counts = window.best_counts();
    let target_from_source = window.target_from_source;
    Verification {
        counts,
        index: verification_index(counts.agreement(), counts.disagreement()),
        source_walls: target.share(&source.walls, &target_from_source),
        target_walls: source.share(&target.walls, &target_from_source.inverse()),
        entropy_offset: window.entropy_offset(),
        slide: window.slide(),
        resolution: target.map.frame().resolution(),
    }
}

impl Verification {
    /// Whether everything that `params` asks for is there.
    #[must_use]
    pub fn is_accepted(&self, params: &VerificationParams) -> bool {
        self.refusal(params).is_none()
    }

    /// Why the transform is not accepted; `None` if it is.
    #[must_use]
    pub fn refusal(&self, params: &VerificationParams) -> Option<Refusal> {
        let area = self.counts.agreement() as f64 * self.resolution * self.resolution;
        let met = self.source_walls.met.min(self.target_walls.met);
        let need = params.min_wall_length / self.resolution;
        if (met as f64) < need {
            let (have_m, need_m) = (met as f64 * self.resolution, params.min_wall_length);
            return Some(Refusal::NoOverlap { have_m, need_m });
        }
        if area < params.min_area {
            return Some(Refusal::TooLittleSharedArea { have_m2: area, need_m2: params.min_area });
        }
        if self.index.is_none_or(|index| index < params.min_index) {
            let conflicts = self.counts.disagreement();
            let compared = conflicts + self.counts.agreement();
            return Some(Refusal::ConflictingCells { conflicts, compared });
        }
        let (cells, limit) = (self.entropy_offset, params.max_entropy_offset);
        if cells > limit {
            return Some(Refusal::EntropyElsewhere { cells, limit });
        }
        if self.slide > params.max_slide {
            return Some(Refusal::Slides { share: self.slide, limit: params.max_slide });
        }
        let walls = if self.source_walls.share() < self.target_walls.share() {
            self.source_walls
        } else {
            self.target_walls
        };
        (walls.share() < params.min_wall_share).then(|| Refusal::Contradiction {
            conflicts: walls.compared - walls.met,
            compared: walls.compared,
        })
    }
}

/// A map's walls and the distance to them.
pub(crate) struct WallField<'a> {
    pub(crate) map: &'a OccupancyGrid,
    pub(crate) walls: Vec<Point2<f64>>,
    /// Squared distance in cells.
    pub(crate) distance_sq: Grid<u32>,
}

impl<'a> WallField<'a> {
    pub(crate) fn new(map: &'a OccupancyGrid, thresholds: &ClassThresholds) -> Option<Self> {
        let distance_sq = l2_distance_sq(&map.occupied_mask(thresholds))?;
        Some(Self { map, walls: map.occupied_points(thresholds), distance_sq })
    }

    /// Of `walls`, in a frame of their own, those that meet a wall of this map.
    fn share(&self, walls: &[Point2<f64>], this_from_other: &Se2) -> WallShare {
        let mut share = WallShare { met: 0, compared: 0 };
        for &wall in walls {
            let Some(cell) = self.map.cell_at(*this_from_other * wall) else { continue };
            if self.is_known(cell) {
                share.compared += 1;
                let near = self.distance_sq.get(cell).is_some_and(|&distance| distance <= 2);
                share.met += usize::from(near);
            }
        }
        share
    }

    fn is_known(&self, cell: CellIndex) -> bool {
        self.map.cells().get(cell).is_some_and(|cell| cell.is_known())
    }
}

#[cfg(test)]
mod tests {
    use super::verification_index;

    #[test]
    fn t_s6_verification_index() {
        assert_eq!(verification_index(9700, 300), Some(97.0));
        assert_eq!(verification_index(0, 0), None);
    }
}
