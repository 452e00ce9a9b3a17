//! The knobs of the distance and of the search.

use std::f64::consts::PI;

use ogm_core::{ClassThresholds, ParameterError, require};

/// How two maps are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistanceParams {
    /// Which cells count.
    pub objective: Objective,
    /// Margin of the canvas around the target on which source cells still count, as a share of the
    /// longest side of either map: 0.5, which leaves 100 × 100 cells a canvas of 200 × 200. With 0 a
    /// source that slides off the target loses its cells and ψ shrinks.
    pub padding: f64,
    /// What is an obstacle and what is free. The default is the paper's: any known cell that is
    /// not exactly one half, by its sign.
    pub thresholds: ClassThresholds,
}

/// Which cells count.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Objective {
    /// All of them: the paper's ψ. Where the maps overlap in part only, its minimum is not at the
    /// true transform, because it draws together what only one robot saw.
    #[default]
    Picture,
    /// Those that lie where the other map is known. Ours, for maps that overlap in part.
    Overlap {
        /// Least cells known in both maps, as a share of those known in the smaller: below it ψ is
        /// infinite, since little overlap always agrees. 0.25 rules out corridors on corridors.
        min_share: f64,
    },
}

impl Default for DistanceParams {
    fn default() -> Self {
        Self { objective: Objective::default(), padding: 0.5, thresholds: by_sign() }
    }
}

/// The narrowest thresholds around one half that storage in steps of 1/254 tells apart.
fn by_sign() -> ClassThresholds {
    ClassThresholds::new(0.499, 0.501).unwrap_or_default()
}

impl DistanceParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let padding = self.padding;
        require((0.0..=2.0).contains(&padding), "padding", "in [0, 2]", padding)?;
        if let Objective::Overlap { min_share } = self.objective {
            let fits = 0.0 < min_share && min_share <= 1.0;
            require(fits, "min_share", "in (0, 1]", min_share)?;
        }
        Ok(())
    }
}

/// How the transform is searched for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// How the maps are compared.
    pub distance: DistanceParams,
    /// Samples of a walk: 200, after which the paper shows its match.
    pub samples: usize,
    /// Decides every random number.
    pub seed: u64,
    /// Walks from the same start, each with random numbers of its own, of which the best counts:
    /// 1, as in the paper. Four cost four times as much and forgive a poor start.
    pub walks: usize,
    /// Around what the search box lies.
    pub around: Around,
    /// How far the source's centre may move to either side, as a share of the mean of both maps'
    /// widths, and likewise up and down: 0.5, 50 of 100 cells.
    pub reach: f64,
    /// How far the source may turn to either side, radians: π, everywhere.
    pub turn: f64,
}

/// The middle of the search box.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Around {
    /// Centre on centre and rows along rows, as in the paper. A start further away is an error.
    #[default]
    Target,
    /// The start.
    Start,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            distance: DistanceParams::default(),
            samples: 200,
            seed: 0,
            walks: 1,
            around: Around::default(),
            reach: 0.5,
            turn: PI,
        }
    }
}

impl Params {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let reach = self.reach;
        require(reach.is_finite() && reach >= 0.0, "reach", "finite and at least 0", reach)?;
        require(self.turn >= 0.0, "turn", "an angle of at least 0", self.turn)?;
        require(self.walks >= 1, "walks", "at least 1", self.walks as f64)
    }
}
