//! From scored poses to distinct modes and what to believe of them.

use nalgebra::Point2;

use crate::mode::{MODE_M, MODE_RAD};
use crate::search::Fit;
use crate::terms::Weights;
use crate::translation::same_place;

/// Score of no pose at all.
pub(crate) const FLOOR: f64 = 0.0;
/// A larger lead over the second mode says no more.
const MOST_LEAD: f64 = 8.0;
/// What is taken for the second mode where there is none, and at least.
const NO_SECOND: f64 = -9.0;

/// The best fit of every mode, best first.
pub(crate) fn modes(mut fits: Vec<Fit>, centre: Point2<f64>) -> Vec<Fit> {
    fits.sort_by(|a, b| {
        b.score.total_cmp(&a.score).then(b.evidence.hit_m.total_cmp(&a.evidence.hit_m))
    });
    let mut modes: Vec<Fit> = Vec::new();
    for fit in fits {
        let pose = &fit.first_from_second;
        if modes
            .iter()
            .all(|mode| !same_place(&mode.first_from_second, pose, centre, MODE_M, MODE_RAD))
        {
            modes.push(fit);
        }
    }
    modes
}

/// What is known about a pair before its maps are looked at.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Beliefs {
    /// Log-odds that a prior pose adds.
    pub(crate) prior: f64,
    /// Whether the building is known to repeat itself.
    pub(crate) repeats: bool,
}

/// Probability of each of `scores`, best first, that it is that of the right pose.
///
/// One of them is right or none: the more likely the better the best fits, and the further it
/// leads over the second, which shows what the wrong poses of this pair reach; the less likely the
/// better a second fits, for where one wrong pose fits well the right one may be one more that was
/// not found. What they have in common they share as their scores say.
pub(crate) fn probabilities(scores: &[f64], beliefs: Beliefs, weights: &Weights) -> Vec<f64> {
    let Some(&best) = scores.first() else { return Vec::new() };
    let second = scores.get(1).copied().unwrap_or(NO_SECOND).max(NO_SECOND);
    let lead = (best - second).clamp(0.0, MOST_LEAD);
    let plain = weights.any + weights.score * best + weights.lead * lead
        - weights.rival * second.max(FLOOR);
    let of_maps = if beliefs.repeats {
        plain.min(weights.repeats_odds * plain - weights.repeats)
    } else {
        plain
    };
    let log_odds = of_maps + beliefs.prior;
    let any = 1.0 / (1.0 + (-log_odds).exp());
    let shares: Vec<f64> = scores.iter().map(|score| (score - best).exp()).collect();
    let total: f64 = shares.iter().sum();
    shares.iter().map(|share| any * share / total).collect()
}

#[cfg(test)]
mod tests {
    use super::{Beliefs, probabilities};
    use crate::weights::WEIGHTS;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn they_are_probabilities_that_add_up_and_follow_the_scores(
            mut scores in proptest::collection::vec(-12.0_f64..25.0, 1..6),
        ) {
            scores.sort_by(|a, b| b.total_cmp(a));
            let found = probabilities(&scores, Beliefs::default(), &WEIGHTS);
            prop_assert!(found.iter().all(|p| (0.0..=1.0).contains(p)));
            prop_assert!(found.iter().sum::<f64>() <= 1.0 + 1e-12);
            prop_assert!(found.is_sorted_by(|a, b| a >= b));
        }

        #[test]
        fn a_prior_raises_them_and_a_building_that_repeats_lowers_them(
            best in -5.0_f64..15.0, second in -12.0_f64..5.0,
        ) {
            let scores = [best.max(second), second];
            let of = |beliefs| probabilities(&scores, beliefs, &WEIGHTS)[0];
            let plain = of(Beliefs::default());
            let helped = of(Beliefs { prior: 2.0, repeats: false });
            let doubted = of(Beliefs { prior: 0.0, repeats: true });
            prop_assert!(helped > plain && doubted <= plain);
        }
    }

    #[test]
    fn equal_poses_share_what_there_is() {
        let found = probabilities(&[9.0, 9.0], Beliefs::default(), &WEIGHTS);
        assert_eq!(found[0], found[1]);
        let alone = probabilities(&[9.0], Beliefs::default(), &WEIGHTS)[0];
        assert!(alone > 0.95, "{alone}");
    }
}
