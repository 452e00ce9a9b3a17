//! The translation, tuned by how far the maps agree at every shift of a window.

use ogm_core::{ClassThresholds, Grid, OccupancyGrid, ParameterError, Se2, require};

use crate::counts::Overlaid;
use crate::{EntropyHistogram, JointCounts, RadonError, joint_entropy};

/// How the translation is tuned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslationParams {
    /// Largest shift an axis, cells: the paper's radius of ten, itself excluded as in Eq. 19.
    pub radius: usize,
    /// Which cells disagree.
    pub disagreement: Disagreement,
    /// What is made greatest.
    pub objective: Objective,
    /// Which histogram the entropy is taken of.
    pub histogram: EntropyHistogram,
}

impl Default for TranslationParams {
    fn default() -> Self {
        Self {
            radius: 9,
            disagreement: Disagreement::KnownInBoth,
            objective: Objective::Walls,
            histogram: EntropyHistogram::KnownInBoth,
        }
    }
}

impl TranslationParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let radius = self.radius as f64;
        require(self.radius <= 200, "translation.radius", "at most 200 cells", radius)
    }
}

/// Which cells of two maps disagree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Disagreement {
    /// Known in both maps and different.
    #[default]
    KnownInBoth,
    /// As in the text after Eq. 17: known in at least one map and different, which makes every
    /// cell that only one robot saw a disagreement.
    AsPrinted,
}

/// What the best translation makes greatest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Objective {
    /// Cells occupied in both maps, less dis. What the maps call free agrees the more the further
    /// they overlap, wherever they belong; walls agree in one place.
    #[default]
    Walls,
    /// agr − dis: Eq. 18 with the sign that the text describes.
    AgreementLessDisagreement,
    /// The entropy's opposite: its least value is the best place, as the paper tunes by entropy in
    /// its last step (Eq. 21).
    LeastEntropy,
    /// |dis − agr|, as in Eq. 18, which is large where the maps contradict each other, too.
    AsPrinted,
}

/// Cells away from the best shift where walls that run across have parted: the faces of one wall
/// and the noise of a map take two or three.
const SLIDE: i64 = 4;

/// How two maps agree at every shift of a window around a start.
#[derive(Debug, Clone, PartialEq)]
pub struct TranslationWindow {
    /// Where the window is centred.
    pub start_target_from_source: Se2,
    /// The tuned transform.
    pub target_from_source: Se2,
    /// The best shift, cells in x and y of the target's lattice.
    pub shift: [i64; 2],
    /// The shift of least entropy, cells.
    pub entropy_shift: [i64; 2],
    /// Class counts at every shift: rows are shifts in y, columns shifts in x, from −radius.
    pub counts: Grid<JointCounts>,
    /// What the objective says at every shift.
    pub similarity: Grid<f64>,
    /// Entropy at every shift, bits.
    pub entropy: Grid<f64>,
}

impl TranslationWindow {
    /// Class counts at the tuned transform.
    #[must_use]
    pub fn best_counts(&self) -> JointCounts {
        let radius = self.counts.width() / 2;
        let position = |shift: i64| usize::try_from(shift + radius as i64).unwrap_or(0);
        let index =
            ogm_core::CellIndex { column: position(self.shift[0]), row: position(self.shift[1]) };
        self.counts.get(index).copied().unwrap_or_default()
    }

    /// Cells between the best shift and that of least entropy, the longer axis.
    #[must_use]
    pub fn entropy_offset(&self) -> u64 {
        let apart = |axis: usize| self.shift[axis].abs_diff(self.entropy_shift[axis]);
        apart(0).max(apart(1))
    }

    /// How many walls still coincide four cells from the best shift, in the direction where
    /// most do, as a share of those at the best shift; 1 if the window is too small to say.
    #[must_use]
    pub fn slide(&self) -> f64 {
        let best = self.best_counts().both_occupied;
        let radius = (self.counts.width() / 2) as i64;
        let ring = self.counts.indexed().filter(|(index, _)| {
            let position = [index.column as i64 - radius, index.row as i64 - radius];
            let away = |axis: usize| (position[axis] - self.shift[axis]).abs();
            away(0).max(away(1)) == SLIDE
        });
        match ring.map(|(_, counts)| counts.both_occupied).max() {
            Some(most) if best > 0 => most as f64 / best as f64,
            _ => 1.0,
        }
    }

    /// Whether the best shift lies at the rim of the window, so that a better one may lie outside.
    #[must_use]
    pub fn is_at_rim(&self) -> bool {
        let radius = (self.counts.width() / 2) as u64;
        self.shift.iter().any(|shift| shift.unsigned_abs() == radius)
    }
}

/// Tries every shift of whole cells around `start_target_from_source` and takes the one where the
/// maps agree best; of equals the one nearest to the start (Saeedi et al., Eqs. 16 to 19).
///
/// # Errors
/// Maps of different resolution, a start that is not finite or leads too far, or a parameter out
/// of range.
pub fn tune_translation(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    start_target_from_source: Se2,
    thresholds: &ClassThresholds,
    params: &TranslationParams,
) -> Result<TranslationWindow, RadonError> {
    params.check()?;
    target.check_same_resolution(source)?;
    let overlaid = Overlaid::new(target, source, &start_target_from_source, thresholds)?;
    let counts = overlaid.counts(params.radius)?;
    let similarity = counts.map(|counts| similarity(counts, params));
    let entropy = counts.map(|counts| joint_entropy(counts, params.histogram));
    let shift = best_shift(&similarity, |a, b| a > b);
    let entropy_shift = best_shift(&entropy, |a, b| a < b);
    let cell = target.frame().resolution();
    let turned = Se2::new(0.0, 0.0, target.frame().map_from_grid().theta());
    let moved = turned * nalgebra::Point2::new(shift[0] as f64 * cell, shift[1] as f64 * cell);
    let target_from_source = Se2::new(moved.x, moved.y, 0.0) * start_target_from_source;
    Ok(TranslationWindow {
        start_target_from_source,
        target_from_source,
        shift,
        entropy_shift,
        counts,
        similarity,
        entropy,
    })
}

/// The objective at one place.
#[must_use]
pub fn similarity(counts: &JointCounts, params: &TranslationParams) -> f64 {
    let disagreement = match params.disagreement {
        Disagreement::KnownInBoth => counts.disagreement(),
        Disagreement::AsPrinted => counts.disagreement() + counts.known_in_one(),
    };
    let difference = counts.agreement() as f64 - disagreement as f64;
    match params.objective {
        Objective::Walls => counts.both_occupied as f64 - disagreement as f64,
        Objective::AgreementLessDisagreement => difference,
        // Nothing known in common has no entropy, and is the worst place.
        Objective::LeastEntropy if counts.agreement() + counts.disagreement() == 0 => {
            f64::NEG_INFINITY
        }
        Objective::LeastEntropy => -joint_entropy(counts, params.histogram),
        Objective::AsPrinted => difference.abs(),
    }
}

/// The best shift; of equals the nearest to the middle, then the first.
fn best_shift(field: &Grid<f64>, is_better: impl Fn(f64, f64) -> bool) -> [i64; 2] {
    let radius = (field.width() / 2) as i64;
    let mut best: Option<(f64, i64, [i64; 2])> = None;
    for (index, &value) in field.indexed() {
        let shift = [index.column as i64 - radius, index.row as i64 - radius];
        let distance_sq = shift[0] * shift[0] + shift[1] * shift[1];
        let better = best.is_none_or(|(most, nearest, _)| {
            is_better(value, most) || (value == most && distance_sq < nearest)
        });
        if better {
            best = Some((value, distance_sq, shift));
        }
    }
    best.map_or([0, 0], |(_, _, shift)| shift)
}
