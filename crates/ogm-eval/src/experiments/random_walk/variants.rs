//! The rows of X5: the walk corrected and as printed, and other searches.

use carpin_walk::{
    Acceptance, Annealing, Drift, HillClimbing, Objective, RandomWalk, Rules, Spread, TurnUnit,
};

use super::record::CORRECTED;

/// A search, its name and what it minimises.
pub(super) struct Variant {
    pub(super) name: &'static str,
    pub(super) rules: Box<dyn Rules + Sync>,
    pub(super) objective: Objective,
}

impl Variant {
    /// Whether it also runs on what the robots' own drives show; the printed forms do not.
    pub(super) fn on_drives(&self) -> bool {
        [CORRECTED, CORRECTED_OVERLAP].contains(&self.name)
    }
}

/// The overlap objective with its default limit.
pub(super) const OVERLAP: Objective = Objective::Overlap { min_share: 0.25 };

const CORRECTED_OVERLAP: &str = "corrected, overlap only";

pub(super) fn variants() -> Vec<Variant> {
    let walk = RandomWalk::default();
    let picture =
        |name, rules: Box<dyn Rules + Sync>| Variant { name, rules, objective: Objective::Picture };
    vec![
        picture(CORRECTED, Box::new(walk)),
        picture(
            "acceptance as printed (pure descent)",
            Box::new(RandomWalk { acceptance: Acceptance::AsPrinted, ..walk }),
        ),
        picture(
            "gradient ascent, as printed",
            Box::new(RandomWalk { drift: Drift::AsPrinted, ..walk }),
        ),
        picture(
            "Σ always 0.1 I (Algorithm 1)",
            Box::new(RandomWalk { spread: Spread::AsPrinted, ..walk }),
        ),
        picture("turns in radians", Box::new(RandomWalk { turn_unit: TurnUnit::Radians, ..walk })),
        picture("μ = 0", Box::new(RandomWalk { drift: Drift::None, ..walk })),
        picture(
            "μ from the last 5 steps",
            Box::new(RandomWalk { drift: Drift::History(5), ..walk }),
        ),
        picture("hill climbing", Box::<HillClimbing>::default()),
        picture("simulated annealing", Box::<Annealing>::default()),
        Variant { name: CORRECTED_OVERLAP, rules: Box::new(walk), objective: OVERLAP },
    ]
}
