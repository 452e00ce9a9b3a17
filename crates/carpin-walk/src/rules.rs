//! The parts of the walk that can be exchanged, and what they are told.

use crate::Placement;

/// The acceptance function, the mean and the covariance of the walk (Carpin and Birk, Definitions
/// 4 to 6 and Algorithm 1).
///
/// [`RandomWalk`](crate::RandomWalk) is the paper's; [`HillClimbing`](crate::HillClimbing) and
/// [`Annealing`](crate::Annealing) are the special cases it names. A walk with rules of its own
/// implements this, handing on to one of those what it does not change.
pub trait Rules {
    /// The mass f_k that the random selector gives to a sample that is not better than where the
    /// walk stands; a better one is always taken. Outside [0, 1] it counts as the nearer end, and
    /// what is not a number as 0.
    fn acceptance(&self, sample_psi: f64, so_far: &WalkState<'_>) -> f64;

    /// μ_k: where the next sample lies on average, from where the walk stands; cells, cells,
    /// degrees. `gradient` estimates that of ψ there, per cell, cell and degree: six evaluations of
    /// ψ, kept until the walk moves on.
    fn mean(&self, so_far: &WalkState<'_>, gradient: &mut dyn FnMut() -> [f64; 3]) -> [f64; 3];

    /// Square roots of the diagonal of Σ_k; cells, cells, degrees.
    fn deviation(&self, so_far: &WalkState<'_>) -> [f64; 3];
}

/// A walk up to the sample that is about to be drawn or scored.
#[derive(Debug, Clone, Copy)]
pub struct WalkState<'a> {
    /// Samples generated before this one.
    pub samples: usize,
    /// ψ where the walk stands.
    pub current_psi: f64,
    /// Least ψ of the start and all samples.
    pub best_psi: f64,
    /// The start and every accepted sample, the last being where the walk stands.
    pub accepted: &'a [Placement],
    /// Samples since the last one that was accepted, the start counting as accepted.
    pub rejected_in_a_row: usize,
}
