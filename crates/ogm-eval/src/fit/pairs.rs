//! Labelled pairs as the fit sees them: the terms of every pose found, and which is right.

use grid_match::{MatchParams, TERMS, match_maps};
use ogm_sim::{FloorKind, Relation, SimError, labelled_pair};
use rayon::prelude::*;

use super::options::FitOptions;
use crate::judge::Truth;

/// Relations of the pairs of one floor kind and seed: as many that must not be merged as that must.
const RELATIONS: [Relation; 4] =
    [Relation::Overlapping, Relation::Overlapping, Relation::Unrelated, Relation::Apart];

/// Terms of a pose.
pub(super) type Terms = [f64; TERMS];

/// Scores of the poses of a pair, best first, and whether one of them is right.
#[derive(Debug, Clone)]
pub(super) struct Scored {
    pub(super) scores: Vec<f64>,
    pub(super) holds_right: bool,
}

/// The poses found for a pair.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    /// Whether the floor repeats itself.
    pub(super) repeats: bool,
    pub(super) poses: Vec<Terms>,
    /// Which of them is right.
    pub(super) right: Option<usize>,
}

impl Pair {
    /// The scores of its poses, best first, and whether one of them is right.
    pub(super) fn scored(&self, bias: f64, weights: &Terms) -> Scored {
        let score = |terms: &Terms| {
            bias + weights.iter().zip(terms).map(|(weight, term)| weight * term).sum::<f64>()
        };
        let mut scores: Vec<f64> = self.poses.iter().map(score).collect();
        scores.sort_by(|a, b| b.total_cmp(a));
        Scored { scores, holds_right: self.right.is_some() }
    }
}

pub(super) fn draw(options: &FitOptions) -> anyhow::Result<Vec<Pair>> {
    let drawn: Vec<(FloorKind, Relation, u64)> = (0..options.count)
        .flat_map(|index| FloorKind::ALL.map(|kind| (index, kind)))
        .flat_map(|(index, kind)| {
            let seed = options.seed + 4 * index;
            (0_u64..).zip(RELATIONS).map(move |(offset, relation)| (kind, relation, seed + offset))
        })
        .collect();
    options.watch.begin("fit: labelled pairs", drawn.len() as u64);
    let pairs: Vec<Option<Pair>> = drawn
        .par_iter()
        .map(|&(kind, relation, seed)| {
            options.watch.step();
            pair(kind, relation, seed)
        })
        .collect::<anyhow::Result<_>>()?;
    options.watch.end();
    Ok(pairs.into_iter().flatten().collect())
}

/// `None` where the floor has no two parts as wanted, or no pose was found.
fn pair(kind: FloorKind, relation: Relation, seed: u64) -> anyhow::Result<Option<Pair>> {
    let pair = match labelled_pair(kind, relation, seed) {
        Ok(pair) => pair,
        Err(SimError::NoSuchPair | SimError::BlockedRoute { .. }) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let report = match_maps(&pair.target, &pair.source, &MatchParams::default(), &())?;
    let cell = pair.target.frame().resolution();
    let truth = pair.truth.map(|truth| Truth::of_simulated(&truth, cell, pair.exact));
    let poses: Vec<Terms> = report.hypotheses.iter().map(|found| found.evidence.terms()).collect();
    let right = truth.and_then(|truth| {
        report
            .hypotheses
            .iter()
            .position(|found| truth.admits(truth.error(&found.pose.target_from_source)))
    });
    Ok((!poses.is_empty()).then_some(Pair { repeats: kind.repeats(), poses, right }))
}
