//! The run on real map pairs: every method on each of them.

use std::path::Path;

use grid_match::{MatchParams, match_maps};
use ogm_core::Se2;
use ogm_merge::{RfidParams, RobotMap, TagMethod, align_by_tags};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::record::{Answered, Answers, MATCH};
use super::tags::localised_tags;
use crate::cases::map_pair::{MapPair, read_pairs};
use crate::judge::Overlap;
use crate::measured::{Run, RunResult};
use crate::options::Options;

const METHODS: [(&str, TagMethod); 3] =
    [("#1", TagMethod::Rfid1), ("#2", TagMethod::Rfid2), ("#3", TagMethod::Rfid3)];

/// What the methods answer on every pair below `folder`.
pub(super) fn run(options: &Options, folder: &Path) -> anyhow::Result<Vec<Answered>> {
    let pairs = read_pairs(folder)?;
    options.watch.begin("pairs", pairs.len() as u64);
    let answers = pairs.par_iter().map(|pair| {
        let answers = answer(pair, options.seed);
        options.watch.step();
        answers
    });
    let answers: Vec<Answers> = answers.collect::<anyhow::Result<_>>()?;
    options.watch.end();
    let answered = pairs.into_iter().zip(answers);
    Ok(answered.map(|(pair, answers)| Answered { pair, answers }).collect())
}

fn answer(pair: &MapPair, seed: u64) -> anyhow::Result<Answers> {
    let run = |variant: &str, result| Run {
        experiment: "pairs",
        case: pair.name.clone(),
        variant: variant.to_owned(),
        seed,
        result,
    };
    let overlap = pair
        .truth
        .as_ref()
        .map(|truth| (truth, Overlap::new(&pair.target, &pair.source, truth.target_from_source)));
    let errors = overlap.as_ref().map(|(truth, overlap)| {
        move |target_from_source: &Se2| truth.errors(overlap, target_from_source)
    });
    let mut answers = Answers::default();
    match localised_tags(pair, seed)? {
        Ok([target_tags, source_tags]) => {
            let target = RobotMap { map: &pair.target, tags: &target_tags };
            let source = RobotMap { map: &pair.source, tags: &source_tags };
            let params = RfidParams::default();
            for (name, method) in METHODS {
                let report = align_by_tags(method, &target, &source, &params, &())?;
                answers.runs.push(run(name, RunResult::of(&report.outcome, errors)));
                answers.target_from_source = report.outcome.found();
                answers.evidence = report.evidence;
            }
        }
        Err(refusal) => {
            let refused = METHODS.map(|(name, _)| run(name, RunResult::Refused(refusal.clone())));
            answers.runs.extend(refused);
        }
    }
    let matched = match_maps(&pair.target, &pair.source, &MatchParams::default(), &())?;
    answers.runs.push(run(MATCH, RunResult::of(&matched.outcome, errors)));
    Ok(answers)
}
