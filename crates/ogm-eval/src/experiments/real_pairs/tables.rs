//! The table of the real pairs.

use super::record::{Answered, Answers, MATCH, NAMES};
use crate::judge::Verdict;
use crate::measured::RunResult;
use crate::report::Table;

pub(super) fn table(answered: &[Answered]) -> Table {
    let rows = answered.iter().map(|one| {
        let (pair, answers) = (&one.pair, &one.answers);
        let [.., by_3, by_match] = NAMES.map(|name| one.verdict(name));
        let [first, second, third, matched] = NAMES.map(|name| shown(one, name));
        let truth = match &pair.truth {
            Some(truth) if truth.exact => "exact".to_owned(),
            Some(truth) => format!("{:.2} m", truth.tolerance.displacement.metres),
            None => "no match".to_owned(),
        };
        let common_tags = answers.evidence.common_tags.len().to_string();
        let agreement = answers.evidence.wall_agreement.and_then(|agreement| agreement.share());
        vec![
            pair.name.clone(),
            truth,
            common_tags,
            first,
            second,
            third,
            text(by_3).to_owned(),
            matched,
            text(by_match).to_owned(),
            agreement.map_or("–".to_owned(), |share| format!("{share:.2}")),
            remarks(answers),
        ]
    });
    let [first, second, third, matched] = NAMES.map(|method| tally(answered, method));
    let empty = String::new;
    let all = vec![
        format!("all {}", answered.len()),
        empty(),
        empty(),
        first,
        second,
        third,
        empty(),
        matched,
        empty(),
        empty(),
        empty(),
    ];
    Table {
        caption: "Error of each method, and the verdicts on #3 and match. Right: inside or \
                  strict; wrong: outside; refused: although the maps match; false: merged although \
                  they do not."
            .to_owned(),
        header: [
            "pair",
            "truth",
            "common tags",
            "#1",
            "#2",
            "#3",
            "verdict on #3",
            MATCH,
            "verdict on match",
            "walls agree",
            "remarks on #3",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.chain([all]).collect(),
    }
}

/// What a method answered on a pair.
fn shown(answered: &Answered, method: &str) -> String {
    match answered.result(method) {
        Some(RunResult::Transform(e)) => {
            format!("{:.3} m, {:.2}°", e.pose.displacement, e.pose.turn.to_degrees())
        }
        Some(RunResult::FalseMerge | RunResult::Direction(_)) => "merged".to_owned(),
        Some(RunResult::Refused(_)) | None => "refused".to_owned(),
    }
}

/// How often the method was how good.
fn tally(answered: &[Answered], method: &str) -> String {
    let count =
        |good: fn(Verdict) -> bool| answered.iter().filter(|one| good(one.verdict(method))).count();
    format!(
        "{} right ({} strict), {} wrong, {} refused, {} false",
        count(Verdict::is_right),
        count(|verdict| verdict == Verdict::Strict),
        count(Verdict::is_outside),
        count(|verdict| verdict == Verdict::Missed),
        count(|verdict| verdict == Verdict::False),
    )
}

/// The words of this table.
fn text(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Near | Verdict::Wrong => "OUTSIDE",
        Verdict::Missed => "refused",
        Verdict::Refused => "rightly refused",
        Verdict::False => "FALSE MERGE",
        right => right.text(),
    }
}

/// Why #3 refused, or what makes its answer less sure than it looks.
fn remarks(answers: &Answers) -> String {
    let refusals = answers.runs.iter().filter(|run| run.variant == "#3");
    let refusals = refusals.filter_map(|run| match &run.result {
        RunResult::Refused(refusal) => Some(refusal.to_string()),
        _ => None,
    });
    let warnings = answers.evidence.warnings().into_iter().map(|warning| warning.to_string());
    refusals.chain(warnings).collect::<Vec<_>>().join("; ")
}
