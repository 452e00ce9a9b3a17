//! Labelled pairs as the fit sees them: the terms of every pose found, and which is right.

use grid_match::{MatchParams, TERMS, match_maps};
use ogm_sim::{FloorKind, Relation, SimError, labelled_pair};
use rayon::prelude::*;

use super::options::FitOptions;
use crate::judge::Truth;

/// Relations of the pairs of one floor kind and seed: more that must not be merged than that must.
const RELATIONS: [Relation; 5] = [
    Relation::Overlapping,
    Relation::Overlapping,
    Relation::Unrelated,
    Relation::Apart,
    Relation::Strangers,
];

/// How much a pair of a floor that repeats itself counts. Most buildings do not; without any the
/// matcher would not learn that rivals are a bad sign.
const REPEATING_WEIGHT: f64 = 0.05;
/// How much two parts of a floor that have nothing in common count: of maps that are not to be
/// merged most are of two places.
const APART_WEIGHT: f64 = 0.25;
/// A pose so many times the tolerance from the truth is neither right nor another place: of bent
/// maps, which lie on each other in more than one way, nothing is to be learnt from it.
const NEAR: f64 = 2.5;

/// Terms of a pose.
pub(super) type Terms = [f64; TERMS];

/// Scores of the poses of a pair, best first, and whether one of them, and the best, is right.
#[derive(Debug, Clone)]
pub(super) struct Scored {
    pub(super) scores: Vec<f64>,
    pub(super) holds_right: bool,
    pub(super) best_is_right: bool,
}

impl Scored {
    /// That of the best of what the poses have in common.
    pub(super) fn share(&self) -> f64 {
        let best = self.scores.first().copied().unwrap_or_default();
        1.0 / self.scores.iter().map(|score| (score - best).exp()).sum::<f64>().max(1.0)
    }
}

/// The poses found for a pair.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    /// Whether the floor repeats itself.
    pub(super) repeats: bool,
    /// How much it counts.
    pub(super) weight: f64,
    pub(super) poses: Vec<Terms>,
    /// Which of them is right.
    pub(super) right: Option<usize>,
}

impl Pair {
    /// Its poses as scores.
    pub(super) fn scored(&self, bias: f64, weights: &Terms) -> Scored {
        let score = |terms: &Terms| {
            bias + weights.iter().zip(terms).map(|(weight, term)| weight * term).sum::<f64>()
        };
        let mut scores: Vec<f64> = self.poses.iter().map(score).collect();
        let right = self.right.map(|right| scores[right]);
        scores.sort_by(|a, b| b.total_cmp(a));
        Scored {
            holds_right: right.is_some(),
            best_is_right: right == scores.first().copied(),
            scores,
        }
    }
}

pub(super) fn draw(options: &FitOptions) -> anyhow::Result<Vec<Pair>> {
    let drawn: Vec<(FloorKind, Relation, u64)> = (0..options.count)
        .flat_map(|index| FloorKind::ALL.map(|kind| (index, kind)))
        .flat_map(|(index, kind)| {
            let seed = options.seed + 5 * index;
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

/// `None` where the floor has no two parts as wanted, no pose was found, or the best lies beside
/// the truth.
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
    let errors: Vec<_> = truth
        .iter()
        .flat_map(|truth| {
            report.hypotheses.iter().map(|found| truth.error(&found.pose.target_from_source))
        })
        .collect();
    let right = truth.and_then(|truth| errors.iter().position(|&error| truth.admits(error)));
    let is_beside = right != Some(0)
        && truth.zip(errors.first()).is_some_and(|(truth, &best)| truth.admits(best.over(NEAR)));
    if poses.is_empty() || is_beside {
        return Ok(None);
    }
    let repeats = kind.repeats();
    let weight = if repeats { REPEATING_WEIGHT } else { 1.0 }
        * if relation == Relation::Apart { APART_WEIGHT } else { 1.0 };
    Ok(Some(Pair { repeats, weight, poses, right }))
}
