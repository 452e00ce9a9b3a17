//! The rules of the paper's experiments, corrected and as printed.

use ogm_core::wrap_period;

use crate::{Rules, WalkState};

/// The rules of Carpin and Birk, section 4.
///
/// Every default is the corrected form; `AsPrinted` follows the letter of the paper, for
/// comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RandomWalk {
    /// How readily a worse sample is taken.
    pub acceptance: Acceptance,
    /// Where samples drift to.
    pub drift: Drift,
    /// When samples spread widely.
    pub spread: Spread,
    /// Variance of a sample after an accepted one, cells² and degrees²: 0.1, the paper's.
    pub near_variance: f64,
    /// Variance of a sample after a rejected one, cells² and degrees²: 10, the paper's.
    pub far_variance: f64,
    /// What one unit of the turn is.
    pub turn_unit: TurnUnit,
}

impl Default for RandomWalk {
    fn default() -> Self {
        Self {
            acceptance: Acceptance::default(),
            drift: Drift::default(),
            spread: Spread::default(),
            near_variance: 0.1,
            far_variance: 10.0,
            turn_unit: TurnUnit::default(),
        }
    }
}

/// How readily a sample that is not better is taken; BD is the best dissimilarity so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Acceptance {
    /// With probability (2 BD − ψ) / BD in [0, 1]: surely at ψ = BD, never from 2 BD on.
    #[default]
    BestRatio,
    /// 2 (BD − ψ) / BD, where the paper's unbalanced parenthesis puts it: never.
    AsPrinted,
}

/// Where samples drift to, one cell (or degree) away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Drift {
    /// Down the gradient of ψ.
    #[default]
    Downhill,
    /// Along the gradient, as printed: up.
    AsPrinted,
    /// Along the mean of so many last accepted steps (Algorithm 1, `Update(t_k … t_k−M)`).
    History(usize),
    /// Nowhere.
    None,
}

/// When samples spread widely.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Spread {
    /// After every rejected sample.
    #[default]
    AfterRejection,
    /// Never: Algorithm 1 updates the covariance only when it accepts.
    AsPrinted,
}

/// The unit in which turns share one variance with cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TurnUnit {
    /// Degrees, in which Definition 2 counts.
    #[default]
    Degrees,
    /// Radians: a deviation of 18 to 181 degrees.
    Radians,
}

impl TurnUnit {
    fn degrees(self) -> f64 {
        match self {
            Self::Degrees => 1.0,
            Self::Radians => 1_f64.to_degrees(),
        }
    }
}

impl Rules for RandomWalk {
    fn acceptance(&self, sample_psi: f64, so_far: &WalkState<'_>) -> f64 {
        let best = so_far.best_psi;
        if best.is_infinite() {
            // Nothing is known yet that could be lost.
            return 1.0;
        }
        match self.acceptance {
            Acceptance::BestRatio => ((2.0 * best - sample_psi) / best).clamp(0.0, 1.0),
            Acceptance::AsPrinted => (2.0 * (best - sample_psi) / best).clamp(0.0, 1.0),
        }
    }

    fn mean(&self, so_far: &WalkState<'_>, gradient: &mut dyn FnMut() -> [f64; 3]) -> [f64; 3] {
        let unit = self.turn_unit.degrees();
        let [x, y, turn] = match self.drift {
            Drift::Downhill => gradient().map(|slope| -slope),
            Drift::AsPrinted => gradient(),
            Drift::History(steps) => {
                let [x, y, degrees] = mean_step(so_far, steps);
                [x, y, degrees / (unit * unit)]
            }
            Drift::None => return [0.0; 3],
        };
        // A slope per degree times the degrees of a unit is the slope per unit.
        let [x, y, turn] = unit_vector([x, y, turn * unit]);
        [x, y, turn * unit]
    }

    fn deviation(&self, so_far: &WalkState<'_>) -> [f64; 3] {
        let searching = so_far.rejected_in_a_row > 0 && self.spread == Spread::AfterRejection;
        let variance = if searching { self.far_variance } else { self.near_variance };
        let deviation = variance.sqrt();
        [deviation, deviation, deviation * self.turn_unit.degrees()]
    }
}

/// The mean of the last `steps` steps that were accepted, as far as there are any.
fn mean_step(so_far: &WalkState<'_>, steps: usize) -> [f64; 3] {
    let last = so_far.accepted.len().saturating_sub(1);
    let from = last.saturating_sub(steps);
    let mut sum = [0.0; 3];
    for pair in so_far.accepted[from..].windows(2) {
        sum[0] += pair[1][0] - pair[0][0];
        sum[1] += pair[1][1] - pair[0][1];
        sum[2] += wrap_period(pair[1][2] - pair[0][2], 360.0);
    }
    sum.map(|total| total / (last - from).max(1) as f64)
}

/// `vector` at length 1; zero and what is not finite stay at zero.
pub(crate) fn unit_vector(vector: [f64; 3]) -> [f64; 3] {
    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() { vector.map(|part| part / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::{Acceptance, Drift, RandomWalk, Spread, TurnUnit};
    use crate::{Rules, WalkState};

    fn at_best(best_psi: f64, rejected_in_a_row: usize) -> WalkState<'static> {
        let accepted = &[[0.0; 3], [3.0, 4.0, 0.0], [3.0, 4.0, 0.0]];
        WalkState { samples: 5, current_psi: best_psi, best_psi, accepted, rejected_in_a_row }
    }

    #[test]
    fn t_c4_acceptance_falls_from_one_at_the_best_to_zero_at_twice_it() {
        let printed = RandomWalk { acceptance: Acceptance::AsPrinted, ..RandomWalk::default() };
        for (psi, expected) in [(10.0, 1.0), (12.0, 0.8), (15.0, 0.5), (20.0, 0.0), (25.0, 0.0)] {
            let p = RandomWalk::default().acceptance(psi, &at_best(10.0, 0));
            assert!((p - expected).abs() < 1e-12, "{psi}: {p}");
            assert_eq!(printed.acceptance(psi, &at_best(10.0, 0)), 0.0, "{psi} as printed");
        }
    }

    #[test]
    fn the_drift_is_one_unit_down_the_gradient_in_whatever_unit() {
        let slope = &mut || [0.3, 0.0, -0.4];
        let so_far = at_best(1.0, 0);
        let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12);
        let down = RandomWalk::default().mean(&so_far, slope);
        assert!(close(down, [-0.6, 0.0, 0.8]), "{down:?}");
        let up = RandomWalk { drift: Drift::AsPrinted, ..RandomWalk::default() };
        assert!(close(up.mean(&so_far, slope), [0.6, 0.0, -0.8]));
        let radians = RandomWalk { turn_unit: TurnUnit::Radians, ..RandomWalk::default() };
        let [x, _, turn] = radians.mean(&so_far, slope);
        assert!((x.hypot(turn.to_radians()) - 1.0).abs() < 1e-12 && turn > 57.0, "{x} {turn}");
        let flat = RandomWalk::default().mean(&so_far, &mut || [0.0; 3]);
        assert_eq!(flat, [0.0; 3], "a plateau has no direction");
        let history = RandomWalk { drift: Drift::History(2), ..RandomWalk::default() };
        assert!(close(history.mean(&so_far, slope), [0.6, 0.8, 0.0]));
    }

    #[test]
    fn samples_spread_after_a_rejection_and_as_printed_never() {
        let walk = RandomWalk::default();
        assert_eq!(walk.deviation(&at_best(1.0, 0))[0], 0.1_f64.sqrt());
        assert_eq!(walk.deviation(&at_best(1.0, 1))[2], 10_f64.sqrt());
        let printed = RandomWalk { spread: Spread::AsPrinted, ..walk };
        assert_eq!(printed.deviation(&at_best(1.0, 1))[0], 0.1_f64.sqrt());
    }
}
