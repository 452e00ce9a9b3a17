//! One row for each run, the same columns for every experiment.

use nalgebra::Point2;
use ogm_core::{Refusal, Se2, wrap_angle};

/// What came of one method on one case.
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

/// How far an estimated transform is from the true one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TransformError {
    /// Mean squared displacement of the source's walls in the true overlap, px² of 0.02 m.
    pub(crate) mse_disp: f64,
    /// Mean squared distance of those walls to the nearest wall of the target, px² of 0.02 m.
    pub(crate) mse_nn: f64,
    /// Displacement of one reference point, metres.
    pub(crate) translation_m: f64,
    /// Absolute rotation error, radians.
    pub(crate) rotation: f64,
}

/// Displacement of `point` and absolute rotation error of an estimate.
pub(crate) fn pose_error(
    estimated_target_from_source: &Se2,
    true_target_from_source: &Se2,
    point: Point2<f64>,
) -> (f64, f64) {
    let displacement =
        (*estimated_target_from_source * point - *true_target_from_source * point).norm();
    let rotation =
        wrap_angle(estimated_target_from_source.theta() - true_target_from_source.theta());
    (displacement, rotation.abs())
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
                format!("{:.6}", e.translation_m),
                format!("{:.6}", e.rotation.to_degrees()),
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
