//! The table and criteria of X6c.

use ogm_core::Outcome;

use super::record::Searched;
use crate::measured::RunResult;
use crate::report::{Criterion, Table};
use crate::stats::Share;

/// Least share of right answers.
const RIGHT: f64 = 0.6;

pub(super) fn success(searched: &[Searched]) -> Criterion {
    let right = Share::holding(searched, |one| one.is_right);
    Criterion {
        id: "X6c success".to_owned(),
        statement: format!("right on {} of {}, at least 60 %", right.hits, right.of),
        paper: Some("works on 3 maps".to_owned()),
        ours: right.fraction(),
        interval: Some(right.ci95()),
        pass: right.fraction() >= RIGHT,
    }
}

pub(super) fn no_wrong(id: &str, searched: &[Searched]) -> Criterion {
    let wrong = searched.iter().filter(|one| one.is_wrong()).count();
    Criterion {
        id: id.to_owned(),
        statement: "no wrong pose is verified".to_owned(),
        paper: None,
        ours: wrong as f64,
        interval: None,
        pass: wrong == 0,
    }
}

pub(super) fn table(cases: &[Searched]) -> Table {
    let rows = cases.iter().map(|case| {
        let dash = || "–".to_owned();
        let candidate = case.right.and_then(|right| case.found.candidates.get(right));
        let error = match &case.result {
            RunResult::Transform(e) => {
                format!("{:.3} m, {:.2}°", e.pose.displacement, e.pose.turn.to_degrees())
            }
            _ => dash(),
        };
        vec![
            case.name.clone(),
            case.found.compared.to_string(),
            case.found.hypotheses.to_string(),
            candidate.map_or_else(dash, |one| (one.hypothesis.order + 1).to_string()),
            case.right.map_or_else(dash, |right| (right + 1).to_string()),
            error,
            if case.is_wrong() { "WRONG".to_owned() } else { outcome_text(&case.found.outcome) },
        ]
    });
    Table {
        caption: "Hypotheses made, the first right one, its rank among the tuned, and the answer."
            .to_owned(),
        header: [
            "maps",
            "segment pairs",
            "hypotheses",
            "first right",
            "right in candidates",
            "error",
            "answer",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.collect(),
    }
}

/// What came out.
fn outcome_text<T>(outcome: &Outcome<T>) -> String {
    outcome.refusal().map_or_else(
        || "verified".to_owned(),
        |refusal| refusal.to_string().split(':').next().unwrap_or_default().to_owned(),
    )
}
