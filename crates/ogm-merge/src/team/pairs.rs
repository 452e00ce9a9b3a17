//! Every pair of a team by itself.

use std::sync::atomic::{AtomicUsize, Ordering};

use grid_match::{PreparedMap, Prior};
use nalgebra::Matrix3;
use ogm_core::{ClassThresholds, Progress, RelativePose, Se2, Stage, Steps};

use super::params::{KnownPose, PairAlignment};
use crate::parallel::map_in_order;
use crate::{
    AlignParams, Hypothesis, MergeError, Method, PairReport, RobotMap, align_pair, align_prepared,
};

/// Standard deviations of a pose by a method that says nothing about them, metres and radians.
const UNSTATED: [f64; 2] = [0.1, 0.02];
/// Probability of an answer by tags, which have none of their own.
const BY_TAGS: f64 = 0.99;

/// One way in which a pair may lie.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Proposal {
    pub(crate) pose: RelativePose,
    pub(crate) score: f64,
    /// Root mean square by which parts of the maps lie elsewhere, metres; zero where nobody looked.
    pub(crate) bend_m: f64,
}

/// A pair, and what it proposes.
#[derive(Debug, Clone)]
pub(crate) struct Matched {
    pub(crate) target: usize,
    pub(crate) source: usize,
    pub(crate) proposals: Vec<Proposal>,
}

impl Matched {
    /// Target and source.
    pub(crate) fn maps(&self) -> (usize, usize) {
        (self.target, self.source)
    }

    fn new(target: usize, source: usize, report: &PairReport) -> Self {
        let is_accepted = report.outcome.clone().found().is_some();
        Self::of(target, source, &report.hypotheses, is_accepted)
    }

    /// What a search found that was done elsewhere, seen from the earlier of the two maps.
    pub(crate) fn elsewhere(alignment: &PairAlignment) -> Self {
        let (target, source) = (alignment.target, alignment.source);
        let mut pair = Self::of(target, source, &alignment.hypotheses, false);
        if target > source {
            (pair.target, pair.source) = (source, target);
            for proposal in &mut pair.proposals {
                proposal.pose = proposal.pose.inverse();
            }
        }
        pair
    }

    fn of(target: usize, source: usize, hypotheses: &[Hypothesis], is_accepted: bool) -> Self {
        let propose = |(index, found): (usize, &Hypothesis)| {
            let by_tags = if is_accepted && index == 0 { BY_TAGS } else { 0.5 };
            let unstated = || {
                let [metres, radians] = UNSTATED.map(|sigma: f64| sigma.powi(2));
                Matrix3::from_diagonal(&nalgebra::Vector3::new(metres, metres, radians))
            };
            Proposal {
                pose: RelativePose {
                    target_from_source: found.target_from_source,
                    covariance: found.covariance.unwrap_or_else(unstated),
                    probability: found.probability.unwrap_or(by_tags),
                },
                score: found.score,
                bend_m: found.bend_m.unwrap_or(0.0),
            }
        };
        let proposals = hypotheses.iter().enumerate().map(propose).collect();
        Self { target, source, proposals }
    }
}

/// Makes every map ready for matching.
pub(crate) fn prepared(
    maps: &[RobotMap<'_>],
    thresholds: &ClassThresholds,
    progress: &dyn Progress,
) -> Result<Vec<PreparedMap>, MergeError> {
    let done = Steps::new(progress, maps.len());
    let prepare = |map: &RobotMap<'_>| {
        let prepared = PreparedMap::new(map.map, thresholds, &())?;
        done.step()?;
        Ok(prepared)
    };
    map_in_order(maps, prepare).into_iter().collect()
}

/// Matches the pairs, as many at once as there are threads: no more memory is held than the
/// prepared maps and what one search a thread takes. `known` says what is known about where a map
/// lies.
pub(crate) fn matched(
    maps: &[RobotMap<'_>],
    prepared: &[PreparedMap],
    pairs: &[(usize, usize)],
    align: &AlignParams,
    known: &(impl Fn(usize) -> Option<KnownPose> + Sync),
    progress: &dyn Progress,
) -> Result<Vec<(Matched, PairReport)>, MergeError> {
    let done = AtomicUsize::new(0);
    let of_pair = |&(target, source): &(usize, usize)| {
        progress.go_on(done.load(Ordering::Relaxed) as f64 / pairs.len() as f64)?;
        let prior = prior(known(target), known(source));
        let has_tags = [target, source].iter().all(|&map| !maps[map].tags.is_empty());
        let silent = Quiet(progress);
        let align = AlignParams { prior, ..align.clone() };
        let report = if has_tags {
            align_pair(Method::Auto, &maps[target], &maps[source], &align, &silent)?
        } else {
            align_prepared(&prepared[target], &prepared[source], &align, &silent)?
        };
        done.fetch_add(1, Ordering::Relaxed);
        Ok((Matched::new(target, source, &report), report))
    };
    let found = map_in_order(pairs, of_pair).into_iter().collect();
    Stage::new(progress, 0.0, 1.0).report(1.0);
    found
}

/// Hears whether to go on, and is not told how far each of many calls has come.
struct Quiet<'a>(&'a dyn Progress);

impl Progress for Quiet<'_> {
    fn report(&self, _share: f64) {}

    fn is_cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// What the poses of two maps say about one in the other.
fn prior(target: Option<KnownPose>, source: Option<KnownPose>) -> Option<Prior> {
    let (target, source) = (target?, source?);
    let target_from_source = target.reference_from_map.between(&source.reference_from_map);
    let arm = target_from_source.translation().norm();
    let turned = target.sigma_rad * arm;
    Some(Prior {
        target_from_source,
        sigma_m: target.sigma_m.hypot(source.sigma_m).hypot(turned),
        sigma_rad: target.sigma_rad.hypot(source.sigma_rad),
    })
}

/// The pose of one map in another where both were given.
pub(crate) fn given(target: Option<KnownPose>, source: Option<KnownPose>) -> Option<Se2> {
    let (target, source) = (target?, source?);
    (target.is_given() && source.is_given())
        .then(|| target.reference_from_map.between(&source.reference_from_map))
}
