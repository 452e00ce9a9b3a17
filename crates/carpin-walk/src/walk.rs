//! Algorithm 1: the Gaussian random walk.

use ogm_core::{Progress, Steps};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::{Placement, Rules, SearchBox, WalkError, WalkState};

/// Steps of the central differences: one cell, one cell, one degree.
const GRADIENT_STEP: f64 = 1.0;

/// How long a walk lasts and which random numbers it draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Samples at most, those outside the box included.
    pub samples: usize,
    /// Seed of the walk.
    pub seed: u64,
    /// Which of the independent walks of this seed.
    pub stream: u64,
}

/// What a walk found on its way.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// Where ψ was least, over the start and every sample, accepted or not.
    pub best: Placement,
    /// ψ there.
    pub best_psi: f64,
    /// ψ at the start.
    pub start_psi: f64,
    /// How often ψ was evaluated, for gradients too.
    pub evaluations: usize,
    /// Every sample in order.
    pub trace: Vec<Sample>,
    /// Why it ended.
    pub end: End,
}

/// One generated sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Where it lies; its turn is not wrapped where it is outside the box.
    pub at: Placement,
    /// ψ there, or `None` outside the box, where nothing is evaluated.
    pub psi: Option<f64>,
    /// Whether the walk went there.
    pub accepted: bool,
    /// ψ where the walk stood after it.
    pub current_psi: f64,
    /// Least ψ so far, this sample included.
    pub best_psi: f64,
}

/// Why a walk ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// All samples were drawn.
    SamplesUsed,
    /// ψ reached zero: there is nothing better.
    OptimumFound,
}

/// Walks through the box from `start` and returns the best place it came by (Carpin and Birk,
/// Algorithm 1).
///
/// A sample is where the walk stands plus a Gaussian vector of the rules' mean and deviation. It is
/// taken if its ψ is less, and otherwise, equality included, if the random selector says so;
/// outside the box it is rejected. The covariance is updated after every sample, not only the
/// accepted. The best placement, not the last, is the answer.
///
/// It visits any set of placements of positive measure with a probability that tends to 1
/// (Theorem 1, which prints 0) as long as the deviations stay bounded away from zero and the
/// means bounded.
///
/// # Errors
/// A start outside the box, or [`WalkError::Cancelled`].
pub fn random_walk<R: Rules + ?Sized>(
    psi: impl FnMut(&Placement) -> f64,
    start: Placement,
    space: &SearchBox,
    rules: &R,
    budget: &Budget,
    progress: &dyn Progress,
) -> Result<Walk, WalkError> {
    let samples = Steps::new(progress, budget.samples);
    let walk = walk(psi, start, space, rules, budget, &samples)?;
    progress.report(1.0);
    Ok(walk)
}

/// [`random_walk`] that counts its samples among those of others.
pub(crate) fn walk<R: Rules + ?Sized>(
    mut psi: impl FnMut(&Placement) -> f64,
    start: Placement,
    space: &SearchBox,
    rules: &R,
    budget: &Budget,
    done: &Steps<'_>,
) -> Result<Walk, WalkError> {
    let start = space.check_start(start)?;
    let mut rng = ChaCha8Rng::seed_from_u64(budget.seed);
    rng.set_stream(budget.stream);

    let start_psi = psi(&start);
    let mut evaluations = 1;
    let (mut current_psi, mut best, mut best_psi) = (start_psi, start, start_psi);
    let mut accepted = vec![start];
    let mut rejected_in_a_row = 0;
    let mut slope = None;
    let mut trace = Vec::new();
    let mut end = End::SamplesUsed;
    for samples in 0..budget.samples {
        if best_psi == 0.0 {
            end = End::OptimumFound;
            break;
        }
        let current = accepted[accepted.len() - 1];
        let so_far =
            WalkState { samples, current_psi, best_psi, accepted: &accepted, rejected_in_a_row };
        let mut gradient = || {
            *slope.get_or_insert_with(|| {
                evaluations += 6;
                gradient_at(&current, &mut psi)
            })
        };
        let mean = rules.mean(&so_far, &mut gradient);
        let deviation = rules.deviation(&so_far);
        let noise: [f64; 3] = std::array::from_fn(|_| StandardNormal.sample(&mut rng));
        let at = std::array::from_fn(|i| current[i] + mean[i] + deviation[i] * noise[i]);
        let luck: f64 = rng.random();

        let inside = space.admit(at).map(|at| {
            evaluations += 1;
            (at, psi(&at))
        });
        if let Some((at, sample_psi)) = inside
            && sample_psi < best_psi
        {
            (best, best_psi) = (at, sample_psi);
        }
        let so_far = WalkState { best_psi, ..so_far };
        let taken = inside.filter(|&(_, sample_psi)| {
            sample_psi < current_psi || luck < rules.acceptance(sample_psi, &so_far)
        });
        if let Some((at, sample_psi)) = taken {
            accepted.push(at);
            current_psi = sample_psi;
            rejected_in_a_row = 0;
            slope = None;
        } else {
            rejected_in_a_row += 1;
        }
        trace.push(Sample {
            at: inside.map_or(at, |(at, _)| at),
            psi: inside.map(|(_, psi)| psi),
            accepted: taken.is_some(),
            current_psi,
            best_psi,
        });
        done.step()?;
    }
    if best_psi == 0.0 {
        end = End::OptimumFound;
    }
    Ok(Walk { best, best_psi, start_psi, evaluations, trace, end })
}

/// Central differences; flat along an axis where ψ is not finite.
fn gradient_at(at: &Placement, psi: &mut impl FnMut(&Placement) -> f64) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let mut beside = |step: f64| {
            let mut place = *at;
            place[axis] += step;
            psi(&place)
        };
        let slope = (beside(GRADIENT_STEP) - beside(-GRADIENT_STEP)) / (2.0 * GRADIENT_STEP);
        if slope.is_finite() { slope } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::{Budget, End, random_walk};
    use crate::{Acceptance, Annealing, HillClimbing, RandomWalk, Rules, SearchBox, WalkState};
    use crate::{WalkError, walk::Walk};

    const SPACE: SearchBox = SearchBox { centre: [0.0; 3], reach: [20.0, 20.0, 180.0] };

    fn valley(at: &[f64; 3]) -> f64 {
        (at[0] - 3.0).abs() + (at[1] + 5.0).abs() + (at[2] - 8.0).abs() + 0.5
    }

    fn walk(rules: &dyn Rules, seed: u64) -> Walk {
        let budget = Budget { samples: 200, seed, stream: 0 };
        random_walk(valley, [0.0; 3], &SPACE, rules, &budget, &()).unwrap()
    }

    #[test]
    fn each_of_the_rules_finds_the_bottom_of_a_valley() {
        let rules: [&dyn Rules; 3] =
            [&RandomWalk::default(), &HillClimbing::default(), &Annealing::default()];
        for (i, rules) in rules.into_iter().enumerate() {
            let found = walk(rules, 3);
            assert!(found.best_psi < 0.2 * found.start_psi, "rules {i}: {}", found.best_psi);
            assert_eq!(found.end, End::SamplesUsed);
        }
    }

    #[test]
    fn the_best_never_gets_worse_and_is_what_is_returned() {
        let found = walk(&RandomWalk::default(), 4);
        assert_eq!(found.trace.len(), 200);
        let bests: Vec<f64> = found.trace.iter().map(|sample| sample.best_psi).collect();
        assert!(bests.is_sorted_by(|a, b| a >= b) && bests[0] <= found.start_psi);
        assert_eq!(found.best_psi, valley(&found.best));
        let least = found.trace.iter().filter_map(|s| s.psi).fold(found.start_psi, f64::min);
        assert_eq!(found.best_psi, least);
        assert!(found.trace.iter().any(|s| s.accepted && Some(s.best_psi) < s.psi), "it climbs");
    }

    #[test]
    fn seeds_and_streams_decide_the_walk() {
        let rules = RandomWalk::default();
        assert_eq!(walk(&rules, 5), walk(&rules, 5));
        assert_ne!(walk(&rules, 5).best, walk(&rules, 6).best);
        let budget = Budget { samples: 200, seed: 5, stream: 1 };
        let other = random_walk(valley, [0.0; 3], &SPACE, &rules, &budget, &()).unwrap();
        assert_ne!(walk(&rules, 5).best, other.best);
    }

    /// Rules of a user: the paper's, but never uphill; said in a way that is no probability.
    struct Cautious(RandomWalk);

    impl Rules for Cautious {
        fn acceptance(&self, _sample_psi: f64, _so_far: &WalkState<'_>) -> f64 {
            f64::NAN
        }

        fn mean(&self, so_far: &WalkState<'_>, gradient: &mut dyn FnMut() -> [f64; 3]) -> [f64; 3] {
            self.0.mean(so_far, gradient)
        }

        fn deviation(&self, so_far: &WalkState<'_>) -> [f64; 3] {
            self.0.deviation(so_far)
        }
    }

    #[test]
    fn a_rule_of_ones_own_replaces_only_what_it_means_to() {
        let found = walk(&Cautious(RandomWalk::default()), 7);
        assert!(found.trace.iter().all(|sample| sample.current_psi == sample.best_psi));
        assert!(found.trace.iter().any(|sample| !sample.accepted));
        assert!(found.best_psi < 0.2 * found.start_psi);
    }

    #[test]
    fn samples_outside_the_box_are_rejected_without_a_look() {
        let corner = SearchBox { centre: [0.0; 3], reach: [0.0, 0.0, 180.0] };
        let budget = Budget { samples: 50, seed: 1, stream: 0 };
        let found =
            random_walk(valley, [0.0; 3], &corner, &RandomWalk::default(), &budget, &()).unwrap();
        assert!(found.trace.iter().all(|sample| sample.psi.is_none() && !sample.accepted));
        assert_eq!((found.best, found.evaluations), ([0.0; 3], 7));
        let outside = random_walk(valley, [1.0; 3], &corner, &RandomWalk::default(), &budget, &());
        assert!(matches!(outside, Err(WalkError::StartOutside { .. })));
    }

    #[test]
    fn a_perfect_match_ends_the_walk_and_a_plateau_is_walked_across() {
        let budget = Budget { samples: 50, seed: 1, stream: 0 };
        let rules = RandomWalk::default();
        let found = random_walk(|_| 0.0, [0.0; 3], &SPACE, &rules, &budget, &()).unwrap();
        assert_eq!((found.end, found.trace.len()), (End::OptimumFound, 0));
        let flat = random_walk(|_| 7.0, [0.0; 3], &SPACE, &rules, &budget, &()).unwrap();
        assert!(flat.trace.iter().all(|sample| sample.accepted || sample.psi.is_none()));
        let printed = RandomWalk { acceptance: Acceptance::AsPrinted, ..rules };
        let stuck = random_walk(|_| 7.0, [0.0; 3], &SPACE, &printed, &budget, &()).unwrap();
        assert!(stuck.trace.iter().all(|sample| !sample.accepted));
        let nowhere =
            random_walk(|_| f64::INFINITY, [0.0; 3], &SPACE, &rules, &budget, &()).unwrap();
        assert!(nowhere.trace.iter().any(|sample| sample.accepted), "it looks around");
    }
}
