//! The race as tables: speed never without correctness.

use std::ops::RangeInclusive;

use super::record::{Outcome, Raced};
use crate::judge::Verdict;
use crate::report::Table;
use crate::stats::quantile;

/// Pairs whose maps have so many cells on average count as about 700 × 600: a quarter either way.
const ABOUT_700_X_600: RangeInclusive<usize> = 315_000..=525_000;

const STANDINGS: &str = "\
Right: merged within 0.25 m and 1°, or within the pair's own tolerance where its truth is less \
exact; the error is taken at the centroid of the source's known cells. Strict: also within one \
cell of the target and 0.5°. Wrong: merged, and neither right nor within 0.5 m and 2°. False: \
merged what must be refused. CPU: seconds of the process with start-up. Own: seconds that the \
command counts itself, without start-up and without reading the maps. Times ours: its own seconds, \
or those of the process if it counts none, over those of our process with start-up; of the \
medians, and the median over the pairs; below 1 the command is the faster one.";

const MIDDLING: &str = "\
Pairs whose maps have 315 000 to 525 000 cells on average; 700 × 600 is 420 000. Columns as above.";

const PAIR_BY_PAIR: &str = "\
CPU seconds: of our process with start-up; of the others their own without start-up and without \
reading the maps. Near: merged within 0.5 m and 2° but not right; missed: refused what matches. A \
dash: not run.";

/// Every table with its title.
pub(super) fn all(names: &[&str], real: &[Raced], sized: &[Raced]) -> Vec<(&'static str, Table)> {
    let every: Vec<&Raced> = real.iter().collect();
    let is_middling = |raced: &&Raced| {
        let [a, b] = raced.pair.cells;
        ABOUT_700_X_600.contains(&((a + b) / 2))
    };
    let middling: Vec<&Raced> = real.iter().filter(is_middling).collect();
    vec![
        ("Real pairs", standings(names, &every, STANDINGS)),
        ("Of these, the pairs of about 700 × 600 cells", standings(names, &middling, MIDDLING)),
        ("Synthetic pairs by size", pair_by_pair(names, sized, PAIR_BY_PAIR)),
        ("Each real pair", pair_by_pair(names, real, "Seconds and words as above.")),
    ]
}

/// One row for each command.
fn standings(names: &[&str], raced: &[&Raced], caption: &str) -> Table {
    let matching = raced.iter().filter(|raced| raced.pair.truth.is_some()).count();
    let header = [
        "".to_owned(),
        format!("right of {matching}"),
        "strict".to_owned(),
        "wrong".to_owned(),
        format!("false of {}", raced.len() - matching),
        "crashes".to_owned(),
        "CPU s, median".to_owned(),
        "p90".to_owned(),
        "max".to_owned(),
        "own s, median".to_owned(),
        "p90".to_owned(),
        "max".to_owned(),
        "times ours, medians".to_owned(),
        "median pair".to_owned(),
    ];
    let rows = names.iter().enumerate().map(|(place, name)| {
        let outcomes: Vec<Outcome> =
            raced.iter().filter_map(|raced| raced.outcomes[place]).collect();
        let count = |good: fn(Verdict) -> bool| {
            outcomes.iter().filter(|outcome| good(outcome.verdict)).count().to_string()
        };
        let mut row = vec![
            (*name).to_owned(),
            count(Verdict::is_right),
            count(|verdict| verdict == Verdict::Strict),
            count(|verdict| verdict == Verdict::Wrong),
            count(|verdict| verdict == Verdict::False),
            count(|verdict| verdict == Verdict::Crash),
        ];
        row.extend(spread(&times(raced, place, |outcome| Some(outcome.cpu_s))));
        row.extend(spread(&times(raced, place, |outcome| outcome.own_cpu_s)));
        let median_ours = quantile(&times(raced, 0, |outcome| Some(outcome.cpu_s)), 0.5);
        let median = quantile(&times(raced, place, |outcome| Some(outcome.bare_s())), 0.5);
        row.push(times_ours(median.zip(median_ours).map(|(theirs, ours)| theirs / ours)));
        row.push(times_ours(quantile(&ratios(raced, place), 0.5)));
        row
    });
    Table { caption: caption.to_owned(), header: header.to_vec(), rows: rows.collect() }
}

/// The times of one command on the pairs that it did not crash on.
fn times(raced: &[&Raced], place: usize, of: fn(Outcome) -> Option<f64>) -> Vec<f64> {
    let outcomes = raced.iter().filter_map(|raced| raced.outcomes[place]);
    outcomes.filter(|outcome| outcome.verdict != Verdict::Crash).filter_map(of).collect()
}

/// The bare time of one command over the time of ours, on each pair that both have answered.
fn ratios(raced: &[&Raced], place: usize) -> Vec<f64> {
    let answered = |raced: &Raced, place: usize| {
        raced.outcomes[place].filter(|outcome| outcome.verdict != Verdict::Crash)
    };
    let pairs = raced.iter().filter_map(|raced| answered(raced, place).zip(answered(raced, 0)));
    pairs.map(|(theirs, ours)| theirs.bare_s() / ours.cpu_s).collect()
}

/// Median, 90 % quantile and maximum.
fn spread(seconds: &[f64]) -> [String; 3] {
    [0.5, 0.9, 1.0].map(|p| quantile(seconds, p).map_or("–".to_owned(), seconds_text))
}

fn times_ours(ratio: Option<f64>) -> String {
    ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.2}"))
}

fn seconds_text(seconds: f64) -> String {
    let decimals = if seconds < 10.0 { 3 } else { 1 };
    format!("{seconds:.decimals$}")
}

/// One row for each pair.
fn pair_by_pair(names: &[&str], raced: &[Raced], caption: &str) -> Table {
    let mut header = vec!["pair".to_owned(), "cells, thousands".to_owned()];
    header.extend(names.iter().map(|name| (*name).to_owned()));
    let rows = raced.iter().map(|raced| {
        let cells = raced.pair.cells.map(|cells| (cells as f64 / 1e3).round().to_string());
        let mut row = vec![raced.pair.name.clone(), cells.join(" + ")];
        row.extend(raced.outcomes.iter().map(|outcome| outcome.map_or("–".to_owned(), cell)));
        row
    });
    Table { caption: caption.to_owned(), header, rows: rows.collect() }
}

fn cell(outcome: Outcome) -> String {
    match outcome.verdict {
        Verdict::Crash => Verdict::Crash.text().to_owned(),
        verdict => format!("{} {}", seconds_text(outcome.bare_s()), verdict.text()),
    }
}

/// A pair on the terminal, while others still run.
pub(super) fn line(raced: &Raced) -> String {
    let cells = raced.outcomes.iter().map(|outcome| outcome.map_or("–".to_owned(), cell));
    format!("{:28} {}", raced.pair.name, cells.collect::<Vec<_>>().join(" | "))
}

#[cfg(test)]
mod tests {
    use super::{Outcome, Raced, Verdict, standings};
    use crate::cases::map_pair::Files;
    use crate::judge::{HALF_A_DOOR, Truth};
    use crate::race::record::Pair;
    use nalgebra::Point2;
    use ogm_core::Se2;

    fn raced(matching: bool, ours: Outcome, theirs: Option<Outcome>) -> Raced {
        let truth = Truth {
            target_from_source: Se2::identity(),
            centre: Point2::origin(),
            radius: 0.0,
            cell: 0.05,
            tolerance: HALF_A_DOOR,
            exact: true,
        };
        let [a, b, a_image, b_image] = ["a.yaml", "b.yaml", "a.pgm", "b.pgm"].map(Into::into);
        let files = Files { a, b, a_image, b_image };
        let name = "pair".to_owned();
        let pair = Pair { name, files, cells: [1, 1], truth: matching.then_some(truth) };
        Raced { pair, outcomes: vec![Some(ours), theirs] }
    }

    fn outcome(verdict: Verdict, cpu_s: f64, own_cpu_s: Option<f64>) -> Outcome {
        Outcome { verdict, cpu_s, own_cpu_s }
    }

    #[test]
    fn times_are_ours_with_start_up_over_theirs_without_and_a_crash_has_none() {
        let pairs = [
            raced(
                true,
                outcome(Verdict::Strict, 0.1, None),
                Some(outcome(Verdict::Wrong, 9.0, Some(1.0))),
            ),
            raced(
                true,
                outcome(Verdict::Inside, 0.2, None),
                Some(outcome(Verdict::Near, 9.0, Some(3.0))),
            ),
            raced(
                true,
                outcome(Verdict::Missed, 0.4, None),
                Some(outcome(Verdict::Crash, 0.01, None)),
            ),
            raced(false, outcome(Verdict::False, 0.3, None), None),
        ];
        let table = standings(&["ours", "theirs"], &pairs.iter().collect::<Vec<_>>(), "");
        assert_eq!(table.header[1..5], ["right of 3", "strict", "wrong", "false of 1"]);
        let [ours, theirs] = [&table.rows[0], &table.rows[1]];
        assert_eq!(ours[..6], ["ours", "2", "1", "0", "1", "0"]);
        assert_eq!(theirs[..6], ["theirs", "0", "0", "1", "0", "1"]);
        assert_eq!(ours[6..], ["0.250", "0.370", "0.400", "–", "–", "–", "1.00", "1.00"]);
        // 2 s over 0.25 s; on the pairs that both have answered 10 and 15.
        assert_eq!(
            theirs[6..],
            ["9.000", "9.000", "9.000", "2.000", "2.800", "3.000", "8.00", "12.50"]
        );
    }
}
