//! What was found about a team, as its JSON says it.

use ogm_merge::{Join, PoseDegrees, TeamReport};
use serde::Serialize;

/// What a team adds to the report of a merge.
#[derive(Debug, Serialize)]
pub(crate) struct TeamAnswer {
    pairs: Vec<PairInTeam>,
    joins: Vec<Join>,
    /// (copy, original), places among the maps.
    copies: Vec<(usize, usize)>,
}

/// Where the team puts a pair, whatever its two maps say by themselves.
#[derive(Debug, Serialize)]
struct PairInTeam {
    target: usize,
    source: usize,
    /// `None` if they do not hang together.
    target_from_source: Option<PoseDegrees>,
    /// Which of the pair's hypotheses agrees, from 0.
    hypothesis: Option<usize>,
}

impl From<&TeamReport> for TeamAnswer {
    fn from(team: &TeamReport) -> Self {
        let pairs = team.pairs.iter().map(|pair| PairInTeam {
            target: pair.target,
            source: pair.source,
            target_from_source: pair.target_from_source.map(PoseDegrees::from),
            hypothesis: pair.hypothesis,
        });
        let (joins, copies) = (team.joins.clone(), team.copies.clone());
        Self { pairs: pairs.collect(), joins, copies }
    }
}
