//! The tables of X3.

use super::record::{count, errors_deg};
use crate::measured::{Run, Timing};
use crate::options::Options;
use crate::report::{Table, format};
use crate::stats::{Summary, student_half_width};

pub(super) fn directions(options: &Options, runs: &[Run]) -> Table {
    let rows = [
        ("X3a", "paper's values, printed weights", "−45.0497 ± 0.5598"),
        ("X3b", "paper's values, corrected weights", "–"),
        ("X3c", "default: least-squares directions, four-fold mean", "–"),
        ("X3d", "default, map turned by 45° and 19 other angles", "–"),
    ]
    .map(|(id, what, paper)| {
        let errors = errors_deg(runs, id);
        let refused = count(runs, id) - errors.len();
        let first = &errors[..errors.len().min(5)];
        let five = Summary::of(first).zip(student_half_width(first));
        let mut row = vec![id.to_owned(), what.to_owned(), paper.to_owned()];
        row.push(five.map_or("–".to_owned(), |(s, half)| {
            format!("{:.4} ± {:.4} (mean ± {half:.4})", s.mean - 45.0, s.sd)
        }));
        match Summary::of(&errors) {
            Some(s) => row.extend([
                format!("{:.4} ± {:.4}", s.mean - 45.0, s.sd),
                format!("{:+.4} [{:+.4}, {:+.4}]", s.mean, s.ci95.0, s.ci95.1),
                format::degrees(s.max.abs().max(s.min.abs())),
                s.n.to_string(),
            ]),
            None => row.extend(["–", "–", "–", "0"].map(str::to_owned)),
        }
        row.push(refused.to_string());
        row
    });
    Table {
        caption: format!(
            "Angle of the OGM vector less the map's heading, mean ± standard deviation, degrees; \
             with Student's t half-width of the mean for five; deviation \
             of the mean from the truth with its bootstrap 95 % interval. Seeds from {}.",
            options.seed
        ),
        header: [
            "",
            "form",
            "paper, 1000 runs",
            "ours, 5 runs",
            "ours, all runs",
            "mean − truth",
            "largest error",
            "runs",
            "refused",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.to_vec(),
    }
}

pub(super) fn times(timings: &[Timing]) -> Table {
    let rows = ["X3a", "X3b", "X3c"].map(|id| {
        let values: Vec<f64> =
            timings.iter().filter(|t| t.experiment == id).map(|t| t.milliseconds).collect();
        let paper = if id == "X3a" { "938.67 ± 154.05" } else { "–" };
        let ours = Summary::of(&values)
            .map_or("–".to_owned(), |s| format!("{:.2} ± {:.2}", s.mean, s.sd));
        vec![id.to_owned(), paper.to_owned(), ours]
    });
    Table {
        caption: "Time from the map to its vector, ms; the paper's on a 2.8 GHz i7, as context."
            .to_owned(),
        header: ["", "paper", "ours"].map(str::to_owned).to_vec(),
        rows: rows.to_vec(),
    }
}
