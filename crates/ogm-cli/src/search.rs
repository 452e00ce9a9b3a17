//! From two map files to the report about them.

use std::path::PathBuf;
use std::time::Instant;

use ogm_core::{Progress, TagEstimate};
use ogm_merge::{AlignParams, FilterParams, MatchParams, Method, Prior, RobotMap, align_pair};

use crate::answer::{PairAnswer, SCHEMA};
use crate::args::SearchArgs;
use crate::input::Input;
use crate::tags::localised;
use crate::usage::UsageError;

/// Whether a method has what it needs and nothing that it cannot use; before anything is read.
pub(crate) fn check(args: &SearchArgs, logs: &[Option<PathBuf>]) -> Result<(), UsageError> {
    let method = Method::from(args.method);
    let name = method.name();
    if method.needs_tags() && logs.iter().any(Option::is_none) {
        let message = format!("--method {name} needs --tags MAP.yaml=TAGS.csv for both maps");
        return Err(UsageError(message));
    }
    if !method.takes_prior() && !args.priors.is_empty() {
        let message = format!("--method {name} takes no --prior; use --method match or carpin");
        return Err(UsageError(message));
    }
    Ok(())
}

/// Finds the transform from the second map into the first, or why there is none.
pub(crate) fn search(
    inputs: [&Input; 2],
    logs: &[Option<PathBuf>],
    args: &SearchArgs,
    prior: Option<Prior>,
    progress: &dyn Progress,
) -> anyhow::Result<PairAnswer> {
    let start = Instant::now();
    let tags = tags(logs, args)?;
    let robot = |map: usize| RobotMap { map: inputs[map].map(), tags: &tags[map] };
    let report =
        align_pair(args.method.into(), &robot(0), &robot(1), &params(args, prior), progress)?;
    Ok(PairAnswer {
        schema: SCHEMA,
        target: inputs[0].file(),
        source: inputs[1].file(),
        report,
        elapsed_ms: u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX),
    })
}

/// The tags of every map.
pub(crate) fn tags(
    logs: &[Option<PathBuf>],
    args: &SearchArgs,
) -> anyhow::Result<Vec<Vec<TagEstimate>>> {
    let reader = FilterParams::for_reader(args.tag_range, args.tag_sigma);
    let tags_of = |log: &Option<PathBuf>| {
        log.as_deref().map_or(Ok(Vec::new()), |log| localised(log, &reader))
    };
    logs.iter().map(tags_of).collect()
}

/// What the command line says about how pairs are aligned.
pub(crate) fn params(args: &SearchArgs, prior: Option<Prior>) -> AlignParams {
    AlignParams {
        seed: args.seed,
        prior,
        matching: MatchParams {
            accept: args.accept,
            repeats: args.repeats,
            ..MatchParams::default()
        },
        walk_objective: args.objective.into(),
        ..AlignParams::default()
    }
}
