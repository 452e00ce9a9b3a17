//! What the real pairs must show.

use super::record::{Answered, NAMES};
use crate::judge::{Truth, Verdict};
use crate::report::Criterion;

/// The criteria on #3 and on match.
pub(super) fn criteria(answered: &[Answered]) -> Vec<Criterion> {
    let [.., by_3, by_match] = NAMES.map(|method| criteria_of(method, answered));
    by_3.into_iter().chain(by_match).collect()
}

fn criteria_of(method: &str, answered: &[Answered]) -> Vec<Criterion> {
    let judged = |of_interest: fn(&Truth) -> bool, good: fn(Verdict) -> bool| {
        let chosen = answered.iter();
        let chosen: Vec<Verdict> = chosen
            .filter(|one| one.pair.truth.as_ref().is_some_and(of_interest))
            .map(|one| one.verdict(method))
            .collect();
        (chosen.iter().filter(|verdict| good(**verdict)).count(), chosen.len())
    };
    let share = |(good, all): (usize, usize)| good as f64 / all as f64;
    let criterion = |what: &str, statement: String, counts, need: f64| Criterion {
        id: format!("pairs: {method} {what}"),
        statement,
        paper: None,
        ours: share(counts),
        interval: None,
        pass: share(counts) >= need,
    };
    let inside = judged(|_| true, Verdict::is_right);
    let strict = judged(|truth| truth.exact, |verdict| verdict == Verdict::Strict);
    let false_merges = answered.iter().filter(|one| one.verdict(method) == Verdict::False).count();
    vec![
        criterion(
            "inside",
            format!(
                "{method} inside the pair's tolerance on {} of {}, at least 22 of 25",
                inside.0, inside.1
            ),
            inside,
            22.0 / 25.0,
        ),
        criterion(
            "strict",
            format!(
                "{method} within one cell and 0.5° on {} of {} with exact truth, at least 12 of 15",
                strict.0, strict.1
            ),
            strict,
            12.0 / 15.0,
        ),
        Criterion {
            id: format!("pairs: {method} false merges"),
            statement: format!("no pair that must be refused is merged by {method}"),
            paper: None,
            ours: false_merges as f64,
            interval: None,
            pass: false_merges == 0,
        },
    ]
}
