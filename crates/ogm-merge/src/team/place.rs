//! Joint poses of maps that hang together, by all pairs that agree with how they were joined.

use grid_match::PreparedMap;
use nalgebra::{Matrix3, center};
use ogm_core::{RelativePose, Se2, wrap_angle};
use pose_graph2d::{Component, Edge, PoseGraph, SolveParams, solve};

use super::pairs::Matched;
use crate::MergeError;

/// A pair agrees with how its maps were joined within this, metres half-way between the middles of
/// the maps and radians: more than the drift of some maps in a row, and what makes another answer.
const AGREES: (f64, f64) = (0.75, 0.1);

/// A map in its place; no covariance where no chain of pairs says one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) map: usize,
    pub(crate) reference_from_map: Se2,
    pub(crate) covariance: Option<Matrix3<f64>>,
    /// The most by which a pair that agrees is bent, root mean square, metres.
    pub(crate) bend_m: f64,
}

/// Which hypothesis of a pair agrees with a pose.
pub(crate) fn agreeing(
    pair: &Matched,
    target_from_source: &Se2,
    prepared: &[PreparedMap],
) -> Option<usize> {
    let [target, source] = [pair.target, pair.source].map(|map| prepared[map].centre());
    let between = center(&source, &(target_from_source.inverse() * target));
    let apart = |found_target_from_source: &Se2| {
        let turn = wrap_angle(found_target_from_source.theta() - target_from_source.theta()).abs();
        let apart = (*found_target_from_source * between - *target_from_source * between).norm();
        (turn <= AGREES.1 && apart <= AGREES.0).then_some(apart)
    };
    let proposals = pair.proposals.iter().enumerate();
    proposals
        .filter_map(|(index, found)| Some((apart(&found.pose.target_from_source)?, index)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, index)| index)
}

/// The poses of least squares of `members`, in their order, with their covariances, in the frame of
/// the member `reference`.
pub(crate) fn placed(
    members: &[(usize, Se2)],
    pairs: &[Matched],
    prepared: &[PreparedMap],
    reference: usize,
) -> Result<Vec<Place>, MergeError> {
    let index = |map: usize| members.iter().position(|(member, _)| *member == map);
    let mut edges: Vec<Edge> = Vec::new();
    let mut pair_bends = Vec::new();
    let mut bends = vec![0.0_f64; members.len()];
    for pair in pairs {
        let Some((target, source)) = index(pair.target).zip(index(pair.source)) else { continue };
        let target_from_source = members[target].1.between(&members[source].1);
        if let Some(agreeing) = agreeing(pair, &target_from_source, prepared) {
            let found = &pair.proposals[agreeing];
            for bend in [target, source] {
                bends[bend] = bends[bend].max(found.bend_m);
            }
            pair_bends.push(found.bend_m);
            let pose = RelativePose { probability: 1.0, ..found.pose };
            edges.push(if target < source {
                Edge { target, source, hypotheses: vec![pose] }
            } else {
                Edge { target: source, source: target, hypotheses: vec![pose.inverse()] }
            });
        }
    }
    edges.sort_by_key(|edge| (edge.target, edge.source));
    let reference = index(reference).unwrap_or(0);
    let loops = edges.len() as f64 / (members.len().max(2) - 1) as f64;
    let freedom = 3.0 * (edges.len() as f64 + 1.0 - members.len() as f64);
    let solved = |edges: Vec<Edge>| -> Result<Option<Component>, MergeError> {
        let graph = PoseGraph { nodes: members.len(), edges };
        let params = SolveParams { references: vec![reference], ..SolveParams::default() };
        let mut components = solve(&graph, &params, &())?.components;
        Ok(components.pop().filter(|_| components.is_empty()))
    };
    let bend_m = median(pair_bends);
    let mut loose = edges.clone();
    for hypothesis in loose.iter_mut().flat_map(|edge| &mut edge.hypotheses) {
        hypothesis.covariance *= loosened(&hypothesis.covariance, bend_m);
    }
    let (found, whole) = (solved(loose)?, solved(edges)?);
    let reference_from_part = members[reference].1.inverse();
    // All pairs of a map share its drift, so that many are no more evidence than a tree of them;
    // and where they disagree by more than they say, none is as sure as it says.
    let disagreement = whole.as_ref().map_or(0.0, |whole| whole.cost) / freedom.max(3.0);
    let inflation = loops.max(1.0) * disagreement.max(1.0);
    let place = |(index, (map, part_from_map)): (usize, &(usize, Se2))| {
        let node = found.as_ref().map(|found| found.nodes[index].reference_from_node);
        let stated = whole.as_ref().and_then(|whole| whole.nodes[index].covariance);
        Place {
            map: *map,
            reference_from_map: node.unwrap_or(reference_from_part * *part_from_map),
            covariance: stated.map(|stated| stated * inflation),
            bend_m: bends[index],
        }
    };
    Ok(members.iter().enumerate().map(place).collect())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// By how much a covariance is to be multiplied so that its better held direction is uncertain by
/// `bend_m` more: what two bent maps share lies elsewhere than what each shares with a third, so
/// that a pair that seems exact says no more about the others than one that does not.
fn loosened(covariance: &Matrix3<f64>, bend_m: f64) -> f64 {
    let turn = covariance[(2, 2)].max(f64::MIN_POSITIVE);
    // At the point about which the pair turns, where translation and turn have nothing in common.
    let arm = covariance.fixed_view::<2, 1>(0, 2) / turn;
    let there = covariance.fixed_view::<2, 2>(0, 0) - arm * arm.transpose() * turn;
    let held = there.symmetric_eigenvalues().min();
    if held > 0.0 { 1.0 + bend_m.powi(2) / held } else { 1.0 }
}
