//! What is kept of a labelled pair, and how pairs are counted.

use ogm_core::Refusal;
use ogm_sim::{FloorKind, MapStyle, Relation};

use crate::judge::{PoseError, TransformError};
use crate::measured::{Run, RunResult};

/// One pair and what was said about it.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    pub(super) kind: FloorKind,
    pub(super) relation: Relation,
    pub(super) seed: u64,
    /// Metres a cell, of the coarser map.
    pub(super) cell: f64,
    pub(super) exact: bool,
    /// Of the smaller map; `None` for maps that must be refused.
    pub(super) overlap: Option<f64>,
    pub(super) best: Option<Best>,
    pub(super) refusal: Option<Refusal>,
    /// Whether the right pose is among the hypotheses.
    pub(super) is_listed: bool,
    /// Who made each map.
    pub(super) styles: [MapStyle; 2],
    /// What no rigid transform removes, root mean square over the shared area, metres.
    pub(super) residual: f64,
    /// Squared error of the best pose in units of its covariance.
    pub(super) nees: Option<f64>,
    /// Whether it is merged where it is known that the building repeats; asked of floors that do.
    pub(super) is_merged_though_it_repeats: Option<bool>,
}

/// The best hypothesis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    pub(super) probability: f64,
    pub(super) is_right: bool,
    /// Root mean square over the shared area; infinite if there is none.
    pub(super) error: PoseError,
}

impl Judged {
    pub(super) fn is_merged(&self) -> bool {
        self.refusal.is_none()
    }

    pub(super) fn is_right(&self) -> bool {
        self.best.is_some_and(|best| best.is_right)
    }

    /// Parts of a floor that repeats itself look like one part seen twice: nothing in the maps
    /// says that they must not be merged.
    pub(super) fn is_decidable(&self) -> bool {
        !(self.kind.repeats() && self.relation == Relation::Apart)
    }
}

/// How many of the pairs something holds for.
pub(super) fn count(judged: &[&Judged], holds: impl Fn(&Judged) -> bool) -> usize {
    judged.iter().filter(|one| holds(one)).count()
}

/// The pairs that overlap and fit.
pub(super) fn to_merge(judged: &[Judged], holds: impl Fn(&Judged) -> bool) -> Vec<&Judged> {
    judged.iter().filter(|one| one.relation == Relation::Overlapping && holds(one)).collect()
}

/// How far the poses of right merges are off, cells of the coarser map: of pairs whose truth is exact
/// and whose floor does not repeat.
pub(super) fn cells_off(judged: &[Judged], holds: impl Fn(&Judged) -> bool) -> Vec<f64> {
    let exact = to_merge(judged, |one| one.exact && !one.kind.repeats() && holds(one));
    let merged = exact.into_iter().filter(|one| one.is_merged() && one.is_right());
    merged.filter_map(|one| Some(one.best?.error.displacement / one.cell)).collect()
}

/// The row of a pair.
pub(super) fn row(judged: &Judged) -> Run {
    let result = match (&judged.refusal, judged.best, judged.overlap) {
        (Some(refusal), _, _) => RunResult::Refused(refusal.clone()),
        (None, Some(best), Some(_)) => RunResult::Transform(TransformError::over_area(best.error)),
        _ => RunResult::FalseMerge,
    };
    Run {
        experiment: "X7",
        case: format!("{}, {:?}", judged.kind.name(), judged.relation).to_lowercase(),
        variant: "match".to_owned(),
        seed: judged.seed,
        result,
    }
}
