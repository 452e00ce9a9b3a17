//! What is kept of a walk.

use crate::measured::Run;
use crate::stats::Share;

/// The walk with every formula corrected, which is judged.
pub(super) const CORRECTED: &str = "corrected";

/// One walk.
#[derive(Debug, Clone)]
pub(super) struct Walked {
    pub(super) case: &'static str,
    pub(super) variant: &'static str,
    pub(super) success: bool,
    /// Whether it ended where the maps look more alike than at the truth.
    pub(super) below_truth: bool,
    pub(super) evaluations: usize,
    /// Share of the known cells that both maps know.
    pub(super) shared: f64,
    pub(super) run: Run,
    pub(super) milliseconds: f64,
}

/// "0.98 [0.90, 1.00]".
pub(super) fn shown(share: Share) -> String {
    if share.of == 0 {
        return "–".to_owned();
    }
    let (low, high) = share.ci95();
    format!("{:.2} [{low:.2}, {high:.2}]", share.fraction())
}
