//! What was found about a team.

use ogm_core::Se2;

use crate::{Component, PairReport};

/// The answer about a team, and what led to it.
#[derive(Debug, Clone)]
#[must_use]
pub struct TeamReport {
    /// Maps that hang together, the component of the reference first, then by their first maps; a
    /// map that could not be placed is alone. Every map is in one of them.
    pub components: Vec<Component>,
    /// Every pair of maps, in the order of their targets, then of their sources; target before
    /// source. Copies of other maps are in none.
    pub pairs: Vec<TeamPair>,
    /// What joined the components, in the order in which it did.
    pub joins: Vec<Join>,
    /// Maps that know the same cells in the same place as an earlier one, which stands for them,
    /// whatever unknown there is around: (copy, original).
    pub copies: Vec<(usize, usize)>,
}

impl TeamReport {
    /// Whether all maps hang together.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.components.len() <= 1
    }

    /// Probability that two maps lie as their component says; 1 for a map and its copy, or for
    /// poses that were given. `None` for maps that do not hang together.
    #[must_use]
    pub fn probability(&self, a: usize, b: usize) -> Option<f64> {
        let original = |map: usize| {
            self.copies.iter().find(|(copy, _)| *copy == map).map_or(map, |(_, original)| *original)
        };
        let [a, b] = [a, b].map(original);
        if a == b {
            return Some(1.0);
        }
        let together =
            |component: &Component| [a, b].iter().all(|&map| component.pose(map).is_some());
        // Maps that no join brought together were given so.
        let given = || self.components.iter().any(together).then_some(1.0);
        probability_between(&self.joins, a, b).or_else(given)
    }
}

/// Probability of the join that brought two maps together; `None` if none of these did.
pub(crate) fn probability_between(joins: &[Join], a: usize, b: usize) -> Option<f64> {
    let joined = |join: &&Join| {
        let has = |map: usize| [join.first.contains(&map), join.second.contains(&map)];
        has(a) == [true, false] && has(b) == [false, true]
            || has(a) == [false, true] && has(b) == [true, false]
    };
    joins.iter().find(joined).map(|join| join.probability)
}

/// A pair of maps in its team.
#[derive(Debug, Clone)]
pub struct TeamPair {
    /// Which map is the target, from 0.
    pub target: usize,
    /// Which map is the source.
    pub source: usize,
    /// What the two maps say by themselves; `None` where both poses were given, or the pair was
    /// searched elsewhere.
    pub report: Option<PairReport>,
    /// Where the team puts the source in the target; `None` if they do not hang together.
    pub target_from_source: Option<Se2>,
    /// Which hypothesis of the report agrees with that, from 0.
    pub hypothesis: Option<usize>,
}

/// Two groups of maps that became one.
#[derive(Debug, Clone, PartialEq)]
pub struct Join {
    /// The maps of one group, ascending.
    pub first: Vec<usize>,
    /// The maps of the other.
    pub second: Vec<usize>,
    /// Probability that they lie on each other as they were joined.
    pub probability: f64,
    /// Log-odds of that by what all of their walls say together, against no pose being right.
    pub score: f64,
}
