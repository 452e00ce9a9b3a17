//! What was found about a pair of maps, as its JSON says it.

use ogm_merge::{PairReport, Verdict};
use serde::Serialize;

use crate::ending::Ending;
use crate::input::MapFile;

/// Version of every JSON object that `ogm` writes.
pub(crate) const SCHEMA: u32 = 1;

/// The report on one pair of map files.
#[derive(Debug, Serialize)]
pub(crate) struct PairAnswer {
    pub(crate) schema: u32,
    pub(crate) target: MapFile,
    pub(crate) source: MapFile,
    #[serde(flatten)]
    pub(crate) report: PairReport,
    pub(crate) elapsed_ms: u64,
}

impl PairAnswer {
    pub(crate) fn ending(&self) -> Ending {
        match self.report.verdict() {
            Verdict::Merged => Ending::Done,
            Verdict::Ambiguous | Verdict::NoMatch => Ending::Refused,
        }
    }
}
