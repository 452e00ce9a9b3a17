//! Where the maps of a merge lie: searched, or as the command line says.

use std::path::PathBuf;
use std::time::Instant;

use ogm_core::{Progress, Se2};
use ogm_merge::{
    AlignParams, Component, KnownPose, PairAlignment, Prior, RobotMap, TeamParams, TeamReport,
    known_poses, merge_team,
};

use crate::answer::{PairAnswer, SCHEMA};
use crate::args::SearchArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::search::{params, search, tags};

/// What was found about the maps.
#[derive(Debug)]
pub(crate) struct Placing {
    pub(crate) pairs: Vec<PairAnswer>,
    /// Target and source of each pair, by their places.
    pub(crate) of_pairs: Vec<[usize; 2]>,
    pub(crate) components: Vec<Component>,
    /// Where more than two maps were searched.
    pub(crate) team: Option<TeamReport>,
}

/// What is known of a team before the search.
#[derive(Debug)]
pub(crate) struct Team {
    pub(crate) reference: usize,
    pub(crate) poses: Vec<KnownPose>,
    pub(crate) alignments: Vec<PairAlignment>,
}

impl Placing {
    /// By a search between two maps.
    pub(crate) fn searched(
        inputs: [&Input; 2],
        logs: &[Option<PathBuf>],
        args: &SearchArgs,
        prior: Option<Prior>,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let pair = search(inputs, logs, args, prior, progress)?;
        let components = pair.report.components();
        Ok(Self { pairs: vec![pair], of_pairs: vec![[0, 1]], components, team: None })
    }

    /// In poses that are known.
    pub(crate) fn known(
        inputs: &[Input],
        reference_from_maps: &[Se2],
        args: &SearchArgs,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let start = Instant::now();
        let maps: Vec<_> = inputs.iter().map(|input| RobotMap::from(input.map())).collect();
        let params = AlignParams { seed: args.seed, ..AlignParams::default() };
        let known = known_poses(&maps, reference_from_maps, &params, progress)?;
        let elapsed_ms = u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX);
        let of_pairs = known.pairs.iter().map(|pair| [pair.target, pair.source]).collect();
        let answers = known.pairs.into_iter().map(|pair| PairAnswer {
            schema: SCHEMA,
            target: inputs[pair.target].file(),
            source: inputs[pair.source].file(),
            report: pair.report,
            elapsed_ms,
        });
        let (pairs, components) = (answers.collect(), vec![known.component]);
        Ok(Self { pairs, of_pairs, components, team: None })
    }

    /// By a search among any number of maps, in the frame of the one at `reference`.
    pub(crate) fn team(
        inputs: &[Input],
        logs: &[Option<PathBuf>],
        team: Team,
        args: &SearchArgs,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let start = Instant::now();
        let tags = tags(logs, args)?;
        let maps = inputs.iter().zip(&tags);
        let maps: Vec<_> = maps.map(|(input, tags)| RobotMap { map: input.map(), tags }).collect();
        let Team { reference, poses, alignments } = team;
        let params = TeamParams { align: params(args, None), poses, alignments, reference };
        let team = merge_team(&maps, &params, progress)?;
        let elapsed_ms = u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX);
        let found = team.pairs.iter().filter_map(|pair| Some((pair, pair.report.clone()?)));
        let (of_pairs, pairs) = found
            .map(|(pair, report)| {
                let [target, source] = [pair.target, pair.source].map(|map| inputs[map].file());
                let answer = PairAnswer { schema: SCHEMA, target, source, report, elapsed_ms };
                ([pair.target, pair.source], answer)
            })
            .unzip();
        Ok(Self { pairs, of_pairs, components: team.components.clone(), team: Some(team) })
    }

    /// Refused if any pair is; of a team, if not all of it hangs together.
    pub(crate) fn ending(&self) -> Ending {
        if let Some(team) = &self.team {
            return if team.is_whole() { Ending::Done } else { Ending::Refused };
        }
        let refused = self.pairs.iter().any(|pair| pair.ending() == Ending::Refused);
        if refused { Ending::Refused } else { Ending::Done }
    }
}
