//! Graduated non-convexity over all hypotheses at once.

use ogm_core::{Progress, Stage};

use crate::candidate::{Candidate, Members};
use crate::constraint::Constraint;
use crate::error::GraphError;
use crate::optimise::Problem;
use crate::params::SolveParams;
use crate::start::start;

/// The control parameter grows by this factor a round: 1.4, as in the paper.
const FACTOR: f64 = 1.4;
/// Rounds at most: with the factor, enough for residuals of 10¹⁰ gates.
const MOST_ROUNDS: usize = 80;
/// Steps of the least squares of a round; the next round goes on from where they end.
const STEPS: usize = 4;
/// Share of a rejected hypothesis that keeps the equations regular.
const LEAST_SHARE: f64 = 1e-6;

/// Which of the members agree.
///
/// Truncated least squares with the weights of Eq. 14 of Yang et al.; the less it costs to call a
/// hypothesis wrong, the less it weighs beside the others.
pub(crate) fn graduated(
    group: &Members<'_>,
    params: &SolveParams,
    progress: &dyn Progress,
) -> Result<Vec<usize>, GraphError> {
    let SolveParams { gate, rotation_error, .. } = *params;
    let Members { candidates, indices, nodes, local } = *group;
    let members: Vec<&Candidate> = indices.iter().map(|&index| &candidates[index]).collect();
    let whole: Vec<Constraint> = members.iter().map(|member| member.constraint(local)).collect();
    let doubted = members.iter().filter(|member| !member.is_given());
    let most = doubted.map(|member| member.evidence()).fold(f64::MIN_POSITIVE, f64::max);
    let worth = |member: &Candidate| (member.evidence() / most).clamp(1e-3, 1.0);
    let worth: Vec<f64> = members.iter().map(|member| worth(member)).collect();
    let mut shares = vec![1.0; whole.len()];
    let weighted = |shares: &[f64]| -> Vec<Constraint> {
        let weights =
            shares.iter().zip(&worth).map(|(share, worth)| share.max(LEAST_SHARE) * worth);
        let terms = whole.iter().zip(weights);
        terms
            .map(|(constraint, weight)| Constraint {
                information: constraint.information * weight,
                ..*constraint
            })
            .collect()
    };
    let mut poses = start(nodes, &weighted(&shares))?;
    let mut control = None;
    for round in 0..MOST_ROUNDS {
        let constraints = weighted(&shares);
        let problem = Problem { constraints: &constraints, rotation_error };
        let stage = Stage::nth(progress, round, MOST_ROUNDS);
        poses = problem.minimise(poses, STEPS, &stage)?.poses;
        let distances: Vec<f64> =
            whole.iter().map(|c| c.distance_sq(&poses, rotation_error)).collect();
        let doubted = members.iter().zip(&distances).filter(|(member, _)| !member.is_given());
        let worst = doubted.map(|(_, &distance)| distance).fold(0.0, f64::max);
        let now: f64 = match control {
            None if worst <= gate => break,
            None => gate / (2.0 * worst - gate),
            Some(before) => FACTOR * before,
        };
        control = Some(now);
        let (low, high) = (now / (now + 1.0) * gate, (now + 1.0) / now * gate);
        for ((share, member), &distance) in shares.iter_mut().zip(&members).zip(&distances) {
            *share = if member.is_given() || distance <= low {
                1.0
            } else if distance >= high {
                0.0
            } else {
                (gate * now * (now + 1.0) / distance).sqrt() - now
            };
        }
        if shares.iter().all(|&share| share == 0.0 || share == 1.0) && now > 1.0 {
            break;
        }
    }
    let kept = indices.iter().zip(&shares).filter(|(_, share)| **share > 0.5);
    Ok(kept.map(|(&index, _)| index).collect())
}
