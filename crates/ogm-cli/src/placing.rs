//! Where the maps of a merge lie: searched, or as the command line says.

use std::path::PathBuf;
use std::time::Instant;

use ogm_core::{Progress, Se2};
use ogm_merge::{AlignParams, Component, RobotMap, known_poses};

use crate::answer::{PairAnswer, SCHEMA};
use crate::args::SearchArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::search::search;

/// What was found about the maps.
#[derive(Debug)]
pub(crate) struct Placing {
    pub(crate) pairs: Vec<PairAnswer>,
    /// Target and source of each pair, by their places.
    pub(crate) of_pairs: Vec<[usize; 2]>,
    pub(crate) components: Vec<Component>,
}

impl Placing {
    /// By a search between two maps.
    pub(crate) fn searched(
        inputs: [&Input; 2],
        logs: &[Option<PathBuf>],
        args: &SearchArgs,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let pair = search(inputs, logs, args, progress)?;
        let components = pair.report.components();
        Ok(Self { pairs: vec![pair], of_pairs: vec![[0, 1]], components })
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
        Ok(Self { pairs: answers.collect(), of_pairs, components: vec![known.component] })
    }

    /// Refused if any pair is.
    pub(crate) fn ending(&self) -> Ending {
        let refused = self.pairs.iter().any(|pair| pair.ending() == Ending::Refused);
        if refused { Ending::Refused } else { Ending::Done }
    }
}
