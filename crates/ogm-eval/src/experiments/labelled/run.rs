//! X7 run: draws labelled pairs of maps and matches them.

use grid_match::{MatchParams, match_maps};
use ogm_core::OccupancyGrid;
use ogm_sim::{FloorKind, LabelledPair, Relation, SimError, labelled_pair};
use rayon::prelude::*;

use super::record::{Best, Judged};
use crate::judge::{PoseError, Truth, nees};
use crate::options::Options;

/// Where the seeds of this experiment begin: the weights of the matcher were fitted on smaller
/// ones, and those from 1 to 4 million judged earlier versions of it.
const FIRST_SEED: u64 = 6_000_000;
/// Relations of the pairs of one floor kind and seed.
const RELATIONS: [Relation; 7] = [
    Relation::Overlapping,
    Relation::Overlapping,
    Relation::Unrelated,
    Relation::Apart,
    Relation::Strangers,
    Relation::Strangers,
    Relation::Strangers,
];
/// How many pairs were drawn, and what was said about those that came about.
pub(super) fn run(options: &Options) -> anyhow::Result<(usize, Vec<Judged>)> {
    let count = if options.quick { 8 } else { options.runs.map_or(100, u64::from) };
    let first = FIRST_SEED + options.seed * 7;
    let drawn: Vec<(FloorKind, Relation, u64)> = (0..count)
        .flat_map(|index| FloorKind::ALL.map(|kind| (index, kind)))
        .flat_map(|(index, kind)| {
            (0_u64..)
                .zip(RELATIONS)
                .map(move |(offset, relation)| (kind, relation, first + 7 * index + offset))
        })
        .collect();
    options.watch.begin("X7 labelled pairs", drawn.len() as u64);
    let judged: Vec<Option<Judged>> = drawn
        .par_iter()
        .map(|&(kind, relation, seed)| {
            options.watch.step();
            match labelled_pair(kind, relation, seed) {
                Ok(pair) => judge(kind, relation, seed, &pair).map(Some),
                Err(SimError::NoSuchPair | SimError::BlockedRoute { .. }) => Ok(None),
                Err(error) => Err(error.into()),
            }
        })
        .collect::<anyhow::Result<_>>()?;
    options.watch.end();
    Ok((drawn.len(), judged.into_iter().flatten().collect()))
}

fn judge(
    kind: FloorKind,
    relation: Relation,
    seed: u64,
    pair: &LabelledPair,
) -> anyhow::Result<Judged> {
    let report = match_maps(&pair.target, &pair.source, &MatchParams::default(), &())?;
    let cell = |map: &OccupancyGrid| map.frame().resolution();
    let truth = pair.truth.map(|truth| Truth::of_simulated(&truth, cell(&pair.target), pair.exact));
    let hypotheses: Vec<Best> = report
        .hypotheses
        .iter()
        .map(|hypothesis| {
            let pose = &hypothesis.pose.target_from_source;
            let nowhere = PoseError { displacement: f64::INFINITY, turn: f64::INFINITY };
            let error = truth.map_or(nowhere, |truth| truth.error(pose));
            let is_right = truth.is_some_and(|truth| truth.admits(error));
            Best { probability: hypothesis.pose.probability, is_right, error }
        })
        .collect();
    let is_merged_though_it_repeats = if kind.repeats() {
        let params = MatchParams { repeats: true, ..MatchParams::default() };
        let report = match_maps(&pair.target, &pair.source, &params, &())?;
        Some(report.outcome.refusal().is_none())
    } else {
        None
    };
    let best = report.hypotheses.first();
    Ok(Judged {
        kind,
        relation,
        seed,
        cell: cell(&pair.target).max(cell(&pair.source)),
        exact: pair.exact,
        overlap: pair.truth.map(|truth| truth.overlap),
        best: hypotheses.first().copied(),
        refusal: report.outcome.refusal().cloned(),
        is_listed: hypotheses.iter().any(|hypothesis| hypothesis.is_right),
        styles: pair.styles,
        residual: pair.truth.map_or(0.0, |truth| truth.residual),
        nees: best.zip(truth).and_then(|(best, truth)| nees(&best.pose, &truth.target_from_source)),
        is_merged_though_it_repeats,
    })
}
