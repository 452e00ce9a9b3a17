//! Hill climbing and simulated annealing as rules of the walk.

use crate::random_walk::unit_vector;
use crate::{Rules, WalkState};

/// Hill climbing: Σ tends to zero and μ follows the gradient (Carpin and Birk, section 2).
///
/// From several seeds it is multipoint hill climbing only if the starts differ: it has no noise to
/// speak of. It ends in the nearest local minimum; Theorem 1 does not hold for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HillClimbing {
    /// Length of the first step from a place, cells or degrees: 2. Each rejection halves it until
    /// the next acceptance, so that the walk does not propose one sample for ever.
    pub step: f64,
}

impl Default for HillClimbing {
    fn default() -> Self {
        Self { step: 2.0 }
    }
}

impl Rules for HillClimbing {
    fn acceptance(&self, _sample_psi: f64, _so_far: &WalkState<'_>) -> f64 {
        0.0
    }

    fn mean(&self, so_far: &WalkState<'_>, gradient: &mut dyn FnMut() -> [f64; 3]) -> [f64; 3] {
        let halvings = i32::try_from(so_far.rejected_in_a_row).unwrap_or(i32::MAX);
        let length = self.step * 0.5_f64.powi(halvings);
        unit_vector(gradient()).map(|part| -length * part)
    }

    fn deviation(&self, _so_far: &WalkState<'_>) -> [f64; 3] {
        [0.0; 3]
    }
}

/// Simulated annealing: a worse sample is taken with probability exp(−Δψ / T), Δψ being how much
/// worse it is than where the walk stands (Kirkpatrick, Gelatt, Vecchi), and samples spread without
/// a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Annealing {
    /// Temperature of the first sample, in units of ψ (cells): 2, at which two maps half a room
    /// apart still move freely.
    pub initial_temperature: f64,
    /// The temperature falls by this factor a sample: 0.98, to a fiftieth over 200 samples.
    pub cooling: f64,
    /// Standard deviation of a sample, cells and degrees: 2, between those of the random walk.
    pub deviation: f64,
}

impl Default for Annealing {
    fn default() -> Self {
        Self { initial_temperature: 2.0, cooling: 0.98, deviation: 2.0 }
    }
}

impl Annealing {
    fn temperature(&self, samples: usize) -> f64 {
        let samples = i32::try_from(samples).unwrap_or(i32::MAX);
        self.initial_temperature * self.cooling.powi(samples)
    }
}

impl Rules for Annealing {
    fn acceptance(&self, sample_psi: f64, so_far: &WalkState<'_>) -> f64 {
        if so_far.current_psi.is_infinite() {
            return 1.0;
        }
        let worse = (sample_psi - so_far.current_psi).max(0.0);
        if worse == 0.0 { 1.0 } else { (-worse / self.temperature(so_far.samples)).exp() }
    }

    fn mean(&self, _so_far: &WalkState<'_>, _gradient: &mut dyn FnMut() -> [f64; 3]) -> [f64; 3] {
        [0.0; 3]
    }

    fn deviation(&self, _so_far: &WalkState<'_>) -> [f64; 3] {
        [self.deviation; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::Annealing;
    use crate::{Rules, WalkState};

    #[test]
    fn annealing_takes_worse_samples_while_it_is_warm() {
        let rules = Annealing { initial_temperature: 2.0, cooling: 0.5, deviation: 1.0 };
        let chance = |samples| {
            let so_far = WalkState {
                samples,
                current_psi: 10.0,
                best_psi: 1.0,
                accepted: &[[0.0; 3]],
                rejected_in_a_row: 0,
            };
            rules.acceptance(12.0, &so_far)
        };
        assert!((chance(0) - (-1_f64).exp()).abs() < 1e-12);
        assert!((chance(1) - (-2_f64).exp()).abs() < 1e-12);
        assert_eq!(chance(5000), 0.0, "frozen, and no division by zero");
    }
}
