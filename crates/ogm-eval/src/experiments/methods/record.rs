//! What the rows of X4 are called and how they are grouped.

use ogm_core::Refusal;

use crate::cases::worlds::Building;
use crate::judge::PIXEL;
use crate::measured::{Run, RunResult};
use crate::stats::Summary;

/// Standard deviation of the error added to each tag as localised, an axis, px of 0.02 m.
pub(super) const REGIMES: [f64; 4] = [0.0, 2.0, 5.0, 10.0];

/// The method that looks at the maps alone. It runs once a world, whatever the tags.
pub(super) const MATCH: &str = "match";

/// Method #3 from two tags.
pub(super) const TWO_TAGS: &str = "two tags";

/// The presets that say what the paper prints.
pub(super) const PRINTED_1: &str = "#1 paper()";
pub(super) const LITERAL: &str = "#3 paper()";

/// The reading of #1 that comes nearest to what the paper reports.
pub(super) const CROPPED_1: &str = "#1 cropped image, turned about its centre, sign repaired";

/// Two robots in different buildings whose tags have equal ids.
pub(super) const NEGATIVES: &str = "different buildings, equal tag ids";

/// Mean squared error and mean time that the paper prints for each method.
pub(super) const TABLE_4: [(&str, &str, &str); 3] =
    [("#1", "7178.27", "0.026"), ("#2", "123.45", "10490.8"), ("#3", "2.6", "18497.6")];

/// The name of a regime on one kind of building.
pub(super) fn case_name(building: Building, sigma_px: f64) -> String {
    let building = building.name();
    if sigma_px == 0.0 {
        format!("{building}, tags as localised")
    } else {
        format!("{building}, tags + {sigma_px:.0} px ({:.0} cm)", sigma_px * PIXEL * 100.0)
    }
}

/// The name of one kind of building where tags do not matter.
pub(super) fn case_without_tags(building: Building) -> String {
    format!("{}, without tags", building.name())
}

/// The runs of one variant in one regime.
pub(super) struct Cell<'a> {
    runs: Vec<&'a Run>,
}

impl<'a> Cell<'a> {
    pub(super) fn new(runs: &'a [Run], case: &str, variant: &str) -> Self {
        let chosen = runs.iter().filter(|run| run.case == case && run.variant == variant);
        Self { runs: chosen.collect() }
    }

    pub(super) fn mse_disp(&self) -> Vec<f64> {
        self.runs.iter().filter_map(|run| run.errors()).map(|errors| errors.mse_disp).collect()
    }

    pub(super) fn mse_nn(&self) -> Vec<f64> {
        self.runs.iter().filter_map(|run| run.errors()).map(|errors| errors.mse_nn).collect()
    }

    /// The runs of seeds below this one.
    pub(super) fn before(&self, seed: u64) -> Self {
        Self { runs: self.runs.iter().filter(|run| run.seed < seed).copied().collect() }
    }

    /// Runs, refused ones too.
    pub(super) fn len(&self) -> usize {
        self.runs.len()
    }

    pub(super) fn refused(&self) -> usize {
        self.runs.iter().filter(|run| matches!(run.result, RunResult::Refused(_))).count()
    }

    /// Refused for want of tags that are known well enough.
    pub(super) fn without_tags(&self) -> usize {
        let lacks_tags = |run: &&&Run| {
            let RunResult::Refused(refusal) = &run.result else { return false };
            matches!(refusal, Refusal::TooFewTags { .. } | Refusal::LowCertainty { .. })
        };
        self.runs.iter().filter(lacks_tags).count()
    }

    /// Answers where there is none.
    pub(super) fn false_merges(&self) -> Vec<u64> {
        let is_false = |run: &&&Run| matches!(run.result, RunResult::FalseMerge);
        self.runs.iter().filter(is_false).map(|run| run.seed).collect()
    }

    pub(super) fn summary(&self) -> Option<Summary> {
        Summary::of(&self.mse_disp())
    }
}
