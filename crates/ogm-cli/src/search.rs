//! From two maps to the answer about them.

use std::path::PathBuf;
use std::time::Instant;

use grid_match::{MatchParams, Prior, match_maps};
use ogm_core::{Outcome, Se2, TagEstimate};
use ogm_merge::{Method, RfidParams, RobotMap};
use rfid_loc::{SelectionParams, common_tags, select_tags};

use crate::answer::{Hypothesis, PairAnswer, SCHEMA, Verdict};
use crate::args::{MethodArg, SearchArgs};
use crate::found::Found;
use crate::input::Input;
use crate::pose::Pose;
use crate::tags::localised;
use crate::terminal;
use crate::untagged::{by_segments, by_walk};
use crate::usage::UsageError;

/// A map and, if there is one, its tag log.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Robot<'a> {
    pub(crate) input: &'a Input,
    pub(crate) log: Option<&'a PathBuf>,
}

/// Whether a method has what it needs and nothing that it cannot use; before anything is read.
pub(crate) fn check(args: &SearchArgs, logs: &[Option<PathBuf>]) -> Result<(), UsageError> {
    let by_tags = matches!(args.method, MethodArg::Rfid1 | MethodArg::Rfid2 | MethodArg::Rfid3);
    if by_tags && logs.iter().any(Option::is_none) {
        let message = "a method by tags needs --tags MAP.yaml=TAGS.csv for both maps";
        return Err(UsageError(message.to_owned()));
    }
    if by_tags && args.prior.is_some() {
        let message = "a method by tags takes no --prior; use --method match or carpin";
        return Err(UsageError(message.to_owned()));
    }
    if args.method == MethodArg::Radon && args.prior.is_some() {
        let message = "--method radon takes no --prior; use --method match or carpin";
        return Err(UsageError(message.to_owned()));
    }
    Ok(())
}

/// Finds the transform from the source into the target, or why there is none.
pub(crate) fn search(
    target: Robot<'_>,
    source: Robot<'_>,
    args: &SearchArgs,
) -> anyhow::Result<PairAnswer> {
    let start = Instant::now();
    let found = match args.method {
        MethodArg::Match => by_maps(target, source, args)?,
        MethodArg::Rfid1 => by_tags(Method::Rfid1, target, source, args)?,
        MethodArg::Rfid2 => by_tags(Method::Rfid2, target, source, args)?,
        MethodArg::Rfid3 => by_tags(Method::Rfid3, target, source, args)?,
        MethodArg::Carpin => by_walk(target.input.map(), source.input.map(), args)?,
        MethodArg::Radon => by_segments(target.input.map(), source.input.map(), args)?,
        MethodArg::Auto => by_what_there_is(target, source, args)?,
    };
    let refusal = found.outcome.refusal();
    let elapsed_ms = u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX);
    Ok(PairAnswer {
        schema: SCHEMA,
        verdict: Verdict::of(refusal),
        reason: refusal.map(ToString::to_string),
        target: target.input.file(),
        source: source.input.file(),
        target_from_source: found.target_from_source,
        probability: found.hypotheses.first().and_then(|best| best.probability),
        overlap: found.overlap,
        agreement: found.agreement,
        hypotheses: found.hypotheses,
        method: found.method,
        seed: args.seed,
        elapsed_ms,
        copies: are_copies(target, source),
    })
}

/// Method #3 where three tags are known well enough in both maps, else the maps alone.
fn by_what_there_is(
    target: Robot<'_>,
    source: Robot<'_>,
    args: &SearchArgs,
) -> anyhow::Result<Found> {
    if let (Some(target_log), Some(source_log)) = (target.log, source.log) {
        let tags = [localised(target_log)?, localised(source_log)?];
        let common = common_tags(&tags[0], &tags[1])?;
        let Some(lacking) = select_tags(&common, &SelectionParams::default()).refusal().cloned()
        else {
            if args.prior.is_some() && !args.quiet {
                terminal::warning("the tags suffice, so --prior is not used; see --method match");
            }
            return from_tags(Method::Rfid3, target, source, &tags, args);
        };
        if !args.quiet {
            terminal::warning(&format!("matching the maps without their tags: {lacking}"));
        }
    }
    by_maps(target, source, args)
}

fn by_maps(target: Robot<'_>, source: Robot<'_>, args: &SearchArgs) -> anyhow::Result<Found> {
    let given = args.prior.zip(args.prior_sigma).map(|(pose, sigma)| Prior {
        target_from_source: pose.into(),
        sigma_m: sigma.metres,
        sigma_rad: sigma.degrees.to_radians(),
    });
    let prior = given.or_else(|| are_copies(target, source).then(|| at_identity(target)));
    let params = MatchParams { accept: args.accept, prior, ..MatchParams::default() };
    let report = match_maps(target.input.map(), source.input.map(), &params, &())?;
    let best = report.hypotheses.first();
    Ok(Found {
        method: "match",
        target_from_source: best.map(|best| best.pose.target_from_source),
        overlap: best.map(|best| best.overlap),
        agreement: best.map(|best| best.agreement),
        hypotheses: report
            .hypotheses
            .iter()
            .map(|hypothesis| Hypothesis {
                pose: Pose::from(hypothesis.pose.target_from_source),
                probability: Some(hypothesis.pose.probability),
                score: hypothesis.score,
                covariance: Some(hypothesis.pose.covariance.into()),
            })
            .collect(),
        outcome: report.outcome,
    })
}

/// Whether both files hold the same cells in the same place.
fn are_copies(target: Robot<'_>, source: Robot<'_>) -> bool {
    target.input.map() == source.input.map()
}

/// Copies are believed to lie on each other: no second robot repeats every cell of the first, so
/// the other ways to lay a symmetric building on itself are no rivals.
fn at_identity(target: Robot<'_>) -> Prior {
    Prior {
        target_from_source: Se2::identity(),
        sigma_m: target.input.map().frame().resolution(),
        sigma_rad: 0.5_f64.to_radians(),
    }
}

fn by_tags(
    method: Method,
    target: Robot<'_>,
    source: Robot<'_>,
    args: &SearchArgs,
) -> anyhow::Result<Found> {
    let tags_of = |robot: Robot<'_>| robot.log.map_or(Ok(Vec::new()), |log| localised(log));
    let tags = [tags_of(target)?, tags_of(source)?];
    from_tags(method, target, source, &tags, args)
}

fn from_tags(
    method: Method,
    target: Robot<'_>,
    source: Robot<'_>,
    tags: &[Vec<TagEstimate>; 2],
    args: &SearchArgs,
) -> anyhow::Result<Found> {
    let mut params = RfidParams::default();
    params.lines.seed = args.seed;
    let [target_map, source_map] = [target.input.map(), source.input.map()];
    let target_robot = RobotMap { map: target_map, tags: &tags[0] };
    let source_robot = RobotMap { map: source_map, tags: &tags[1] };
    let report = ogm_merge::align(method, &target_robot, &source_robot, &params)?;
    let target_from_source = match &report.outcome {
        Outcome::Found(target_from_source) => Some(*target_from_source),
        Outcome::Refused(_) => report.evidence.start_target_from_source,
    };
    let name = match method {
        Method::Rfid1 | Method::Rfid1b => "rfid1",
        Method::Rfid2 => "rfid2",
        Method::Rfid3 => "rfid3",
    };
    Found::scored(name, report.outcome, target_from_source, [target_map, source_map])
}
