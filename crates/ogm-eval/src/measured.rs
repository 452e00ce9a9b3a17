//! What an experiment hands on: sections of the report, and a row for each run.

use ogm_core::{Outcome, Refusal, Se2};

use crate::judge::TransformError;
use crate::report::Section;

/// What an experiment hands to the report.
#[derive(Debug, Clone, Default)]
pub(crate) struct Measured {
    pub(crate) sections: Vec<Section>,
    pub(crate) runs: Vec<Run>,
    pub(crate) timings: Vec<Timing>,
}

/// Wall time of one step of one run; never in a result file.
#[derive(Debug, Clone)]
pub(crate) struct Timing {
    pub(crate) experiment: &'static str,
    pub(crate) step: &'static str,
    pub(crate) seed: u64,
    pub(crate) milliseconds: f64,
}

/// What came of one method on one case; one row, the same columns for every experiment.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub(crate) experiment: &'static str,
    pub(crate) case: String,
    pub(crate) variant: String,
    pub(crate) seed: u64,
    pub(crate) result: RunResult,
}

/// The measured errors, or why there are none.
#[derive(Debug, Clone)]
pub(crate) enum RunResult {
    Transform(TransformError),
    /// Signed error of a direction, radians.
    Direction(f64),
    Refused(Refusal),
    /// An answer where the maps do not match.
    FalseMerge,
}

impl Measured {
    pub(crate) fn of_section(section: Section) -> Self {
        Self { sections: vec![section], ..Self::default() }
    }

    pub(crate) fn extend(&mut self, other: Self) {
        self.sections.extend(other.sections);
        self.runs.extend(other.runs);
        self.timings.extend(other.timings);
    }
}

impl RunResult {
    /// What a search answered; `errors` is `None` for maps that do not match.
    pub(crate) fn of(
        outcome: &Outcome<Se2>,
        errors: Option<impl FnOnce(&Se2) -> TransformError>,
    ) -> Self {
        match (outcome, errors) {
            (Outcome::Refused(refusal), _) => Self::Refused(refusal.clone()),
            (Outcome::Found(target_from_source), Some(errors)) => {
                Self::Transform(errors(target_from_source))
            }
            (Outcome::Found(_), None) => Self::FalseMerge,
        }
    }
}

impl Run {
    pub(crate) fn errors(&self) -> Option<&TransformError> {
        match &self.result {
            RunResult::Transform(errors) => Some(errors),
            _ => None,
        }
    }

    pub(crate) const HEADER: [&'static str; 10] = [
        "experiment",
        "case",
        "variant",
        "seed",
        "outcome",
        "mse_disp_px2",
        "mse_nn_px2",
        "translation_error_m",
        "rotation_error_deg",
        "reason",
    ];

    pub(crate) fn cells(&self) -> Vec<String> {
        let mut cells = vec![
            self.experiment.to_owned(),
            self.case.clone(),
            self.variant.clone(),
            self.seed.to_string(),
        ];
        match &self.result {
            RunResult::Transform(e) => cells.extend([
                "found".to_owned(),
                format!("{:.6}", e.mse_disp),
                format!("{:.6}", e.mse_nn),
                format!("{:.6}", e.pose.displacement),
                format!("{:.6}", e.pose.turn.to_degrees()),
                String::new(),
            ]),
            RunResult::Direction(error) => cells.extend([
                "found".to_owned(),
                String::new(),
                String::new(),
                String::new(),
                format!("{:.6}", error.to_degrees()),
                String::new(),
            ]),
            RunResult::FalseMerge => {
                cells.push("false merge".to_owned());
                cells.extend(std::iter::repeat_n(String::new(), 5));
            }
            RunResult::Refused(refusal) => {
                cells.push("refused".to_owned());
                cells.extend(std::iter::repeat_n(String::new(), 4));
                cells.push(refusal.to_string());
            }
        }
        cells
    }
}
