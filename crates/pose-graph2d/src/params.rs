//! The knobs of the solution.

use ogm_core::{ParameterError, require};

/// How hypotheses that contradict each other are told apart.
///
/// On a hundred teams of eight maps where three edges of ten favour a wrong pose, the first spoils
/// 7 and the second 20 (`cargo test -p pose-graph2d -- --ignored --nocapture`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Selection {
    /// Graduated non-convexity with truncated least squares: Yang, Antonante, Tzoumas, Carlone,
    /// *Graduated Non-Convexity for Robust Spatial Perception* (2020).
    #[default]
    Graduated,
    /// Grows a set of hypotheses that agree around every loop from each of the surest ones, and
    /// keeps the set with the most evidence. For tens of nodes, with edges between most of them.
    Consistent,
}

/// How the difference of two rotations counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RotationError {
    /// By the angle δ between them, as in g2o.
    #[default]
    Angle,
    /// By the chord 2 sin(δ/2), as in SE-Sync: Rosen, Carlone, Bandeira, Leonard, *SE-Sync* (2019).
    /// The optimum of this cost can be certified.
    Chord,
}

/// How a graph is solved.
#[derive(Debug, Clone, PartialEq)]
pub struct SolveParams {
    /// How hypotheses are told apart.
    pub selection: Selection,
    /// How the difference of two rotations counts.
    pub rotation_error: RotationError,
    /// Squared Mahalanobis distance from which on a hypothesis contradicts the others: 16.27, which
    /// one right hypothesis in a thousand exceeds (χ² of three degrees of freedom).
    pub gate: f64,
    /// Least probability of a hypothesis that alone holds two parts together, with no loop that
    /// would confirm it: 0.9, that of an accepted match.
    pub accept: f64,
    /// The nodes in whose frame a component is given, the first that it holds; where it holds none
    /// of them, its first node.
    pub references: Vec<usize>,
    /// Whether to compute the covariance of every node, which takes one solution of the normal
    /// equations a node.
    pub covariances: bool,
    /// Most steps of one least squares problem: 100.
    pub max_iterations: usize,
}

impl Default for SolveParams {
    fn default() -> Self {
        Self {
            selection: Selection::default(),
            rotation_error: RotationError::default(),
            gate: 16.27,
            accept: 0.9,
            references: Vec::new(),
            covariances: true,
            max_iterations: 100,
        }
    }
}

impl SolveParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let (gate, accept) = (self.gate, self.accept);
        require(gate > 0.0 && gate.is_finite(), "gate", "finite and above 0", gate)?;
        require((0.0..=1.0).contains(&accept), "accept", "in [0, 1]", accept)?;
        let steps = self.max_iterations;
        require(steps >= 1, "max_iterations", "at least 1", steps as f64)
    }
}
