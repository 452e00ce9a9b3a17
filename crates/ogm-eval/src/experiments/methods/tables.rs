//! The tables of X4.

use std::collections::{BTreeMap, BTreeSet};

use super::record::{Cell, MATCH, NEGATIVES, REGIMES, TABLE_4, case_name, case_without_tags};
use super::variants::{VARIANTS, methods};
use crate::cases::worlds::Building;
use crate::judge::{METHOD_3, SAME_WALLS};
use crate::measured::{Run, RunResult, Timing};
use crate::options::Options;
use crate::report::{Table, format};
use crate::stats::{Share, Summary, student_half_width};

pub(super) fn table_4(options: &Options, runs: &[Run]) -> Table {
    let mut rows = Vec::new();
    for sigma_px in REGIMES {
        let case = case_name(Building::Random, sigma_px);
        rows.extend(
            TABLE_4.map(|(variant, paper, _)| result(options, runs, &case, variant, paper)),
        );
        rows.extend(
            methods()[TABLE_4.len()..].iter().map(|name| result(options, runs, &case, name, "–")),
        );
    }
    rows.push(result(options, runs, &case_without_tags(Building::Random), MATCH, "–"));
    Table {
        caption: format!(
            "Mean squared displacement, px² of 0.02 m. Five runs with Student's t half-width; all \
             worlds with the bootstrap 95 % interval of the mean. Refused runs are counted, not \
             averaged. Seeds from {}.",
            options.seed
        ),
        header: [
            "regime",
            "method",
            "paper",
            "ours, 5 runs",
            "ours, all worlds",
            "median",
            "mse_nn",
            "worlds",
            "refused",
            "> 100 px²",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows,
    }
}

/// A row of the table of results.
fn result(options: &Options, runs: &[Run], case: &str, variant: &str, paper: &str) -> Vec<String> {
    let cell = Cell::new(runs, case, variant);
    let five = cell.before(options.seed + 5).mse_disp();
    let mut row = vec![case.to_owned(), variant.to_owned(), paper.to_owned()];
    row.push(match (Summary::of(&five), student_half_width(&five)) {
        (Some(summary), Some(half)) => {
            format!("{} ± {}", format::px2(summary.mean), format::px2(half))
        }
        (Some(summary), None) => format::px2(summary.mean),
        (None, _) => "–".to_owned(),
    });
    row.extend(match cell.summary() {
        Some(s) => [
            format!(
                "{} [{}, {}]",
                format::px2(s.mean),
                format::px2(s.ci95.0),
                format::px2(s.ci95.1)
            ),
            format::px2(s.median),
        ],
        None => ["–".to_owned(), "–".to_owned()],
    });
    let beyond = cell.mse_disp().iter().filter(|&&mse| SAME_WALLS.excludes_walls(mse)).count();
    row.extend([
        format::px2(Summary::of(&cell.mse_nn()).map_or(f64::NAN, |s| s.mean)),
        cell.len().to_string(),
        cell.refused().to_string(),
        beyond.to_string(),
    ]);
    row
}

/// Wall times are context: the paper's machine was another. They go to the caption-less table of
/// the report and to timings.csv, never into a result file.
pub(super) fn times(timings: &[Timing]) -> Table {
    let methods = TABLE_4.map(|(variant, _, paper)| (variant, paper));
    let rows = methods.into_iter().chain([(MATCH, "–")]).map(|(variant, paper)| {
        let values: Vec<f64> =
            timings.iter().filter(|t| t.step == variant).map(|t| t.milliseconds).collect();
        let ours = Summary::of(&values);
        vec![
            variant.to_owned(),
            paper.to_owned(),
            ours.as_ref().map_or("–".to_owned(), |s| format!("{:.3}", s.median)),
            ours.as_ref().map_or("–".to_owned(), |s| format!("{:.3}", s.max)),
        ]
    });
    Table {
        caption: "Time to find the transform, ms, tags already localised. The paper's (2.8 GHz \
                  i7) is context, not a criterion; it quotes 0.026 and 0.02 ms for #1."
            .to_owned(),
        header: ["method", "paper, mean", "ours, median", "ours, longest"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
    }
}

pub(super) fn variants(runs: &[Run], building: Building) -> Table {
    let shown = |case: &str, variant: &str| {
        let cell = Cell::new(runs, case, variant);
        let counts = format!("{} − {}", cell.len(), cell.refused());
        match (cell.summary(), Summary::of(&cell.mse_nn())) {
            (Some(disp), Some(nn)) => format!(
                "{} / {} / {} ({counts})",
                format::px2(disp.mean),
                format::px2(disp.median),
                format::px2(nn.mean)
            ),
            _ => format!("– ({counts})"),
        }
    };
    let rows = VARIANTS.iter().map(|variant| {
        let cells = REGIMES.map(|sigma_px| shown(&case_name(building, sigma_px), variant.name));
        [vec![variant.name.to_owned()], cells.to_vec()].concat()
    });
    let matched = shown(&case_without_tags(building), MATCH);
    let matched = [MATCH, &matched, "the same", "the same", "the same"].map(str::to_owned).to_vec();
    let name = match building {
        Building::Random => "random plans",
        Building::PlanA => "plan A, ten seeds",
    };
    Table {
        caption: format!(
            "All variants on {name}: mean mse_disp / median mse_disp / mean mse_nn, px² (runs − \
             refused). Unguarded and as printed, no answer is refused for what tags or walls say \
             about it. The printed forms of #1 depend on the frame's origin: that of the start pose \
             unless said. {MATCH} takes no tags."
        ),
        header: ["variant", "tags as localised", "+ 2 px", "+ 5 px", "+ 10 px"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.chain([matched]).collect(),
    }
}

/// Every method on robots that were in different buildings.
pub(super) fn strangers(runs: &[Run]) -> Table {
    let row = |variant: &&'static str| {
        let cell = Cell::new(runs, NEGATIVES, variant);
        let merged = cell.false_merges();
        let seeds: Vec<String> = merged.iter().map(u64::to_string).collect();
        let (low, high) = Share { hits: merged.len(), of: cell.len() }.ci95();
        vec![
            (*variant).to_owned(),
            cell.len().to_string(),
            merged.len().to_string(),
            format!("{:.1}–{:.1} %", 100.0 * low, 100.0 * high),
            if seeds.is_empty() { "–".to_owned() } else { seeds.join(", ") },
        ]
    };
    Table {
        caption:
            "Different buildings whose tags have equal ids: each world's first robot with the \
                  second of the next. Every merge is wrong."
                .to_owned(),
        header: ["method", "pairs", "merged", "95 % interval", "seeds"].map(str::to_owned).to_vec(),
        rows: methods().iter().map(row).collect(),
    }
}

/// One row for each world and what went wrong there, with the regimes and methods it struck.
pub(super) fn failures(runs: &[Run]) -> Table {
    let refined = |variant: &str| ["#3", MATCH].contains(&variant);
    let mut struck: BTreeMap<(u64, String), BTreeSet<String>> = BTreeMap::new();
    let defaults = TABLE_4.map(|(name, ..)| name).into_iter().chain([MATCH]);
    let defaults: Vec<&str> = defaults.collect();
    for run in runs.iter().filter(|run| defaults.contains(&run.variant.as_str())) {
        let what = match &run.result {
            RunResult::Refused(refusal) => refusal.to_string(),
            RunResult::Transform(e)
                if refined(&run.variant) && METHOD_3.excludes_walls(e.mse_disp) =>
            {
                format!("mse_disp {} px²", format::px2(e.mse_disp))
            }
            _ => continue,
        };
        let where_struck = format!("{} ({})", run.case, run.variant);
        struck.entry((run.seed, what)).or_default().insert(where_struck);
    }
    let rows = struck.into_iter().map(|((seed, what), cases)| {
        let cases: Vec<String> = cases.into_iter().collect();
        let all = TABLE_4.len() * REGIMES.len();
        let cases = if cases.len() == all {
            "all regimes of #1, #2 and #3".to_owned()
        } else {
            cases.join(", ")
        };
        vec![seed.to_string(), what, cases]
    });
    Table {
        caption: "Every refused run of the defaults, and every run of #3 and match beyond 2.6 px²."
            .to_owned(),
        header: ["seed", "what", "where"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}
