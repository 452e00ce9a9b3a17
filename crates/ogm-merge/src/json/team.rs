//! What a team says.

use serde::{Serialize, Serializer};

use crate::{Join, PairReport, PoseDegrees, TeamPair};

#[derive(Serialize)]
struct TeamPairJson<'a> {
    /// What the two maps say by themselves; absent where both poses were given.
    #[serde(flatten)]
    report: Option<&'a PairReport>,
    team: InTeam,
}

#[derive(Serialize)]
struct InTeam {
    /// `None` if they do not hang together.
    target_from_source: Option<PoseDegrees>,
    /// Which of the hypotheses agrees, from 0.
    hypothesis: Option<usize>,
}

impl Serialize for TeamPair {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pair = TeamPairJson {
            report: self.report.as_ref(),
            team: InTeam {
                target_from_source: self.target_from_source.map(PoseDegrees::from),
                hypothesis: self.hypothesis,
            },
        };
        pair.serialize(serializer)
    }
}

#[derive(Serialize)]
struct JoinJson<'a> {
    first: &'a [usize],
    second: &'a [usize],
    probability: f64,
    score: f64,
}

impl Serialize for Join {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { first, second, probability, score } = self;
        JoinJson { first, second, probability: *probability, score: *score }.serialize(serializer)
    }
}
