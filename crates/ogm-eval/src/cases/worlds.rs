//! What the methods are run on: two robots in one building, their tags localised.

use nalgebra::Vector2;
use ogm_core::{Se2, TagEstimate};
use ogm_sim::{FloorPlan, PairParams, SimulatedPair, simulate_pair};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rfid_loc::{FilterParams, localise};

use crate::judge::PIXEL;

/// Two maps of one building, the tags as each robot localised them, and the truth.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) pair: SimulatedPair,
    pub(crate) target_tags: Vec<TagEstimate>,
    pub(crate) source_tags: Vec<TagEstimate>,
    pub(crate) seed: u64,
}

/// What a building of a seed looks like.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Building {
    Random,
    PlanA,
}

impl Building {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Random => "random plan",
            Self::PlanA => "plan A",
        }
    }
}

impl World {
    pub(crate) fn simulate(building: Building, seed: u64) -> anyhow::Result<Self> {
        let plan = match building {
            Building::Random => FloorPlan::random(seed)?,
            Building::PlanA => FloorPlan::plan_a(),
        };
        let pair = simulate_pair(&plan, &PairParams { seed, ..PairParams::default() })?;
        let filter = FilterParams::default();
        let target_tags = localise(&pair.target.readings, &filter, &())?;
        let source_tags = localise(&pair.source.readings, &filter, &())?;
        Ok(Self { pair, target_tags, source_tags, seed })
    }

    pub(crate) fn target_from_source(&self) -> Se2 {
        self.pair.target_from_source
    }

    /// The tags as if each robot had misplaced each of them by a Gaussian of `sigma_px` an axis.
    pub(crate) fn displaced_tags(&self, sigma_px: f64) -> [Vec<TagEstimate>; 2] {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        // Streams of their own, so that the error is independent of everything in the world.
        rng.set_stream(0x7a65);
        let mut displace = |tags: &[TagEstimate]| {
            let displaced = tags.iter().map(|tag| {
                let unit = Vector2::from_fn(|_, _| StandardNormal.sample(&mut rng));
                TagEstimate { position: tag.position + unit * (sigma_px * PIXEL), ..*tag }
            });
            displaced.collect()
        };
        [displace(&self.target_tags), displace(&self.source_tags)]
    }
}
