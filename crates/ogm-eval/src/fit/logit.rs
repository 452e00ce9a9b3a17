//! Conditional and plain logistic regression with weights that are not below zero.

use grid_match::{TERMS, Weights};

use super::pairs::{Pair, Scored, Terms};

/// Keeps weights finite where the pairs are separable: half the square of each counts so much.
const RIDGE: f64 = 0.04;
/// Sweeps over the weights.
const SWEEPS: usize = 400;
/// Bounds of the lead and of the score of a missing second, as in the matcher.
const MOST_LEAD: f64 = 8.0;
const NO_SECOND: f64 = -9.0;

/// Bias and weights under which the right pose stands out among those found and against none,
/// and the loss a pair.
pub(super) fn fit_poses(pairs: &[Pair]) -> (f64, Terms, f64) {
    let mut parameters = [0.3; TERMS + 1];
    parameters[0] = -3.0;
    let total: f64 = pairs.iter().map(|pair| pair.weight).sum();
    let mut loss = f64::INFINITY;
    for _ in 0..SWEEPS {
        for index in 0..=TERMS {
            let (slope, curvature) = pose_slope(pairs, &parameters, index);
            let step = slope / curvature.max(1e-9);
            let least = if index == 0 { f64::NEG_INFINITY } else { 0.0 };
            parameters[index] = (parameters[index] - step.clamp(-1.0, 1.0)).max(least);
        }
        let next = pose_loss(pairs, &parameters) / total;
        if (loss - next).abs() < 1e-9 {
            break;
        }
        loss = next;
    }
    let mut terms = [0.0; TERMS];
    terms.copy_from_slice(&parameters[1..]);
    (parameters[0], terms, loss)
}

fn pose_scores(pair: &Pair, parameters: &[f64; TERMS + 1]) -> Vec<f64> {
    let score = |terms: &Terms| {
        let weighted = parameters[1..].iter().zip(terms).map(|(weight, term)| weight * term);
        parameters[0] + weighted.sum::<f64>()
    };
    pair.poses.iter().map(score).collect()
}

/// Probabilities of the poses, the rest being that of none, and the logarithm of their sum.
fn shares(scores: &[f64]) -> (Vec<f64>, f64) {
    let most = scores.iter().copied().fold(0.0, f64::max);
    let weights: Vec<f64> = scores.iter().map(|score| (score - most).exp()).collect();
    let total = weights.iter().sum::<f64>() + (-most).exp();
    (weights.iter().map(|weight| weight / total).collect(), most + total.ln())
}

fn pose_loss(pairs: &[Pair], parameters: &[f64; TERMS + 1]) -> f64 {
    pairs
        .iter()
        .map(|pair| {
            let scores = pose_scores(pair, parameters);
            let (_, normaliser) = shares(&scores);
            pair.weight * (normaliser - pair.right.map_or(0.0, |right| scores[right]))
        })
        .sum()
}

/// First and second derivative of the loss by one parameter.
fn pose_slope(pairs: &[Pair], parameters: &[f64; TERMS + 1], index: usize) -> (f64, f64) {
    let ridge = if index == 0 { 0.0 } else { RIDGE };
    let mut slope = ridge * parameters[index];
    let mut curvature = ridge;
    for pair in pairs {
        let (shares, _) = shares(&pose_scores(pair, parameters));
        let value = |pose: usize| if index == 0 { 1.0 } else { pair.poses[pose][index - 1] };
        let mean: f64 = shares.iter().enumerate().map(|(pose, share)| share * value(pose)).sum();
        let square: f64 =
            shares.iter().enumerate().map(|(pose, share)| share * value(pose).powi(2)).sum();
        slope += pair.weight * (mean - pair.right.map_or(0.0, value));
        curvature += pair.weight * (square - mean * mean);
    }
    (slope, curvature)
}

/// What the best score, its lead and its rival say about whether any pose is right: the weights
/// of [`Weights`] `any`, `score`, `lead`, `rival`, and the loss a pair.
pub(super) fn fit_any(scored: &[Scored], pairs: &[Pair]) -> ([f64; 4], f64) {
    let mut parameters = [0.0, 0.5, 0.5, 0.5];
    let total: f64 = pairs.iter().map(|pair| pair.weight).sum();
    let mut loss = f64::INFINITY;
    for _ in 0..SWEEPS {
        for index in 0..4 {
            let ridge = if index == 0 { 0.0 } else { RIDGE };
            let (mut slope, mut curvature) = (ridge * parameters[index], ridge);
            for (one, pair) in scored.iter().zip(pairs) {
                let features = features(&one.scores);
                let probability = sigmoid(dot(&features, &parameters));
                let label = f64::from(u8::from(one.holds_right));
                slope += pair.weight * (probability - label) * features[index];
                curvature +=
                    pair.weight * probability * (1.0 - probability) * features[index].powi(2);
            }
            let step = (slope / curvature.max(1e-9)).clamp(-1.0, 1.0);
            let least = if index == 0 { f64::NEG_INFINITY } else { 0.0 };
            parameters[index] = (parameters[index] - step).max(least);
        }
        let next = scored
            .iter()
            .zip(pairs)
            .map(|(one, pair)| {
                let odds = dot(&features(&one.scores), &parameters);
                pair.weight * softplus(if one.holds_right { -odds } else { odds })
            })
            .sum::<f64>()
            / total;
        if (loss - next).abs() < 1e-9 {
            break;
        }
        loss = next;
    }
    (parameters, loss)
}

/// What is left of the log-odds on floors that repeat themselves, so that as many best poses are
/// right there as is said: what is taken off, and the share that is kept of them.
pub(super) fn fit_repeats(scored: &[Scored], pairs: &[Pair], weights: &Weights) -> [f64; 2] {
    let Weights { any, score, lead, rival, .. } = *weights;
    let mut kept = [0.0, 1.0];
    for _ in 0..SWEEPS {
        for index in 0..2 {
            let (mut slope, mut curvature) = (0.0, 1e-9);
            for (one, _) in scored.iter().zip(pairs).filter(|(_, pair)| pair.repeats) {
                let odds = dot(&features(&one.scores), &[any, score, lead, rival]);
                let features = [-1.0, odds];
                let probability = sigmoid(dot(&features, &kept)) * one.share();
                let right = f64::from(u8::from(one.best_is_right));
                slope += (probability - right) * features[index];
                curvature += probability * (1.0 - probability) * features[index].powi(2);
            }
            kept[index] = (kept[index] - (slope / curvature).clamp(-1.0, 1.0)).max(0.0);
        }
        kept[1] = kept[1].min(1.0);
    }
    kept
}

fn features(scores: &[f64]) -> [f64; 4] {
    let best = scores.first().copied().unwrap_or(NO_SECOND);
    let second = scores.get(1).copied().unwrap_or(NO_SECOND).max(NO_SECOND);
    [1.0, best, (best - second).clamp(0.0, MOST_LEAD), -second.max(0.0)]
}

fn dot<const N: usize>(features: &[f64; N], parameters: &[f64; N]) -> f64 {
    features.iter().zip(parameters).map(|(feature, parameter)| feature * parameter).sum()
}

fn sigmoid(odds: f64) -> f64 {
    1.0 / (1.0 + (-odds).exp())
}

/// ln(1 + exp(x)), without overflow.
fn softplus(x: f64) -> f64 {
    x.max(0.0) + (-x.abs()).exp().ln_1p()
}

#[cfg(test)]
mod tests {
    use super::{fit_any, fit_poses};
    use crate::fit::pairs::Pair;
    use grid_match::TERMS;

    /// The first term says which pose is right, the second says nothing.
    fn pairs() -> Vec<Pair> {
        (0..400_u32)
            .map(|index| {
                let noise = |salt: u32| f64::from((index * 37 + salt * 101) % 97) / 97.0;
                let holds_right = index % 2 == 0;
                let pose = |right: bool, salt: u32| {
                    let mut terms = [0.0; TERMS];
                    terms[0] = noise(salt) + if right { 1.2 } else { 0.0 };
                    terms[1] = noise(salt + 7);
                    terms
                };
                let poses = vec![pose(holds_right, 1), pose(false, 2), pose(false, 3)];
                Pair { repeats: false, weight: 1.0, poses, right: holds_right.then_some(0) }
            })
            .collect()
    }

    #[test]
    fn what_tells_right_from_wrong_gets_the_weight_and_the_likelihood_grows() {
        let pairs = pairs();
        let (bias, terms, loss) = fit_poses(&pairs);
        assert!(terms[0] > 2.0 && terms[0] > 5.0 * terms[1], "{terms:?}");
        assert!(loss < 0.5 * 4.0_f64.ln(), "{loss}: better than drawing lots");
        let scored: Vec<_> = pairs.iter().map(|pair| pair.scored(bias, &terms)).collect();
        let ([_, score, lead, _], loss) = fit_any(&scored, &pairs);
        assert!(score + lead > 0.5 && loss < 0.5 * 2.0_f64.ln(), "{score} {lead} {loss}");
    }
}
