//! The tables of X8.

use super::record::{Filter, Placed, Robot, Team};
use crate::report::{Table, number};
use crate::stats::{mean, median, quantile, wilson_ci95};

fn table(caption: &str, header: &[&str], rows: Vec<Vec<String>>) -> Table {
    let header = header.iter().map(|&name| name.to_owned()).collect();
    Table { caption: caption.to_owned(), header, rows }
}

fn figure(value: Option<f64>) -> String {
    number(value.unwrap_or(f64::NAN))
}

pub(super) fn filters(robots: &[&Robot]) -> Table {
    let lengths: Vec<f64> = robots.iter().map(|robot| robot.length).collect();
    let row = |filter: Filter| {
        let ends = || robots.iter().map(|robot| robot.end(filter));
        let errors: Vec<f64> = ends().map(|end| end.error.displacement).collect();
        let turns: Vec<f64> = ends().map(|end| end.error.turn.to_degrees()).collect();
        let nees: Vec<f64> = ends().filter_map(|end| end.nees).collect();
        let [used, gated, refused] =
            [0, 1, 2].map(|index| ends().map(|end| end.scans[index]).sum::<usize>());
        vec![
            filter.name().to_owned(),
            robots.len().to_string(),
            figure(median(&errors)),
            figure(quantile(&errors, 0.9)),
            figure(median(&turns)),
            figure(mean(&nees)),
            format!("{used} / {gated} / {refused}"),
        ]
    };
    let caption = format!(
        "Error of the last pose after {:.0} m on average, and how it compares with the stated \
         covariance.",
        mean(&lengths).unwrap_or(f64::NAN)
    );
    let header = [
        "filter",
        "runs",
        "median error, m",
        "90 % below, m",
        "median turn, °",
        "mean NEES (3)",
        "scans used / gated / unmatched",
    ];
    table(&caption, &header, Filter::ALL.map(row).to_vec())
}

/// "12 of 40, 30 % [18, 45]".
fn share_of(hits: usize, of: usize) -> String {
    let (low, high) = wilson_ci95(hits, of);
    let percent = 100.0 * hits as f64 / of.max(1) as f64;
    format!("{hits} of {of}, {percent:.0} % [{:.0}, {:.0}]", 100.0 * low, 100.0 * high)
}

pub(super) fn shares(teams: &[Team]) -> Table {
    let moments = teams.first().map_or(0, |team| team.shares.len());
    let mut rows = Vec::new();
    for moment in 0..moments {
        for map in 0..2 {
            let placed: Vec<&Placed> =
                teams.iter().map(|team| &team.shares[moment].placed[map]).collect();
            let count =
                |holds: fn(&Placed) -> bool| placed.iter().filter(|placed| holds(placed)).count();
            let found = |value: fn(f64, f64, f64) -> f64| -> Vec<f64> {
                let of = |placed: &&Placed| match placed {
                    Placed::Found { error, is_right: true, verification } => {
                        Some(value(error.displacement, error.turn, *verification))
                    }
                    _ => None,
                };
                placed.iter().filter_map(of).collect()
            };
            rows.push(vec![
                format!("{} of {moments}", moment + 1),
                format!("map {} to map 1", map + 2),
                share_of(count(Placed::is_right), placed.len()),
                count(Placed::is_wrong).to_string(),
                figure(median(&found(|metres, _, _| metres))),
                figure(median(&found(|_, turn, _| turn.to_degrees()))),
                figure(median(&found(|_, _, index| index))),
            ]);
        }
    }
    table(
        "Each sharing: maps placed rightly and wrongly, the rest refused; errors and verification \
         index of those placed rightly, 97 % and 98 % in the paper.",
        &["third", "map", "right", "wrong", "median error, m", "median turn, °", "median V, %"],
        rows,
    )
}

pub(super) fn fused(teams: &[Team]) -> Table {
    let moments = teams.first().map_or(0, |team| team.shares.len());
    let row = |moment: usize| {
        let of = |value: fn(&super::record::Share) -> f64| -> Vec<f64> {
            teams.iter().map(|team| value(&team.shares[moment])).collect()
        };
        let maps = of(|share| {
            1.0 + share.placed.iter().filter(|placed| !matches!(placed, Placed::Refused(_))).count()
                as f64
        });
        let walls = of(|share| share.walls as f64);
        let right = of(super::record::Share::right_percent);
        vec![
            format!("{} of {moments}", moment + 1),
            figure(mean(&maps)),
            figure(median(&walls)),
            figure(median(&right)),
            figure(quantile(&right, 0.0)),
        ]
    };
    table(
        "The fused map in the frame of the first robot: wall cells within 0.15 m of a wall of the \
         plan.",
        &["third", "maps in it, mean", "wall cells, median", "right, median %", "least %"],
        (0..moments).map(row).collect(),
    )
}
