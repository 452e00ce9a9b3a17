//! The front door: two maps and a method in, one report out.

use grid_match::{
    Evidence, MatchParams, MatchReport, PreparedMap, Prior, match_maps, match_prepared,
};
use nalgebra::Matrix3;
use ogm_core::{Outcome, Progress, Refusal, Se2, Stage};
use radon_merge::{Candidate, RadonParams};
use rfid_loc::{common_tags, select_tags};

use crate::report::{Hypothesis, Stages};
use crate::schedule::walk_coarse_to_fine;
use crate::segments::align_by_radon;
use crate::tagged::align_by_tags;
use crate::{
    AlignParams, MergeError, Method, PairReport, RfidParams, RobotMap, TagMethod, Warning,
};

/// Finds the transform that maps points of `source` into the frame of `target`.
///
/// Every decision about a pair of maps is taken here: which method [`Method::Auto`] is, what
/// stands in where it refuses, where a walk starts, and whether its end is believed. The maps may
/// differ in resolution, origin and yaw.
///
/// Maps that hold the same cells in the same place are taken for copies, and
/// [`Method::Match`] looks for them at the identity only: no second robot repeats every cell of
/// the first, so the other ways to lay a symmetric building on itself are no rivals.
///
/// A prior of no uncertainty is the pose ([`Method::Known`]) to every method that takes one.
///
/// # Errors
/// Input that cannot be meant, or a call that was cancelled; a valid pair that holds too little
/// is a refused outcome.
pub fn align_pair(
    method: Method,
    target: &RobotMap<'_>,
    source: &RobotMap<'_>,
    params: &AlignParams,
    progress: &dyn Progress,
) -> Result<PairReport, MergeError> {
    let pair = Pair { target, source, params };
    let is_exact = |prior: &Prior| prior.sigma_m == 0.0 && prior.sigma_rad == 0.0;
    let is_given = method.takes_prior() && params.prior.as_ref().is_some_and(is_exact);
    let mut report = match if is_given { Method::Known } else { method } {
        Method::Auto => pair.by_what_there_is(progress),
        Method::Match => pair.by_maps(progress),
        Method::Tags(method) => pair.by_tags(method, progress),
        Method::Carpin => pair.by_walk(progress),
        Method::Radon => pair.by_segments(progress),
        Method::Known => pair.as_given(progress),
    }?;
    if pair.are_copies() {
        report.warnings.push(Warning::Copies);
    }
    report.warnings.extend(pair.readings_dropped());
    progress.report(1.0);
    Ok(report)
}

/// As [`align_pair`] by [`Method::Match`], of maps that were made ready before, for those that are
/// matched with many others. Copies are not looked for.
///
/// # Errors
/// Parameters that cannot be meant, or a call that was cancelled.
pub fn align_prepared(
    target: &PreparedMap,
    source: &PreparedMap,
    params: &AlignParams,
    progress: &dyn Progress,
) -> Result<PairReport, MergeError> {
    let matching = MatchParams { prior: params.prior, ..params.matching.clone() };
    let found = match_prepared(target, source, &matching, progress)?;
    Ok(PairReport::of_match(found, params.seed))
}

/// A map that seems longer by more than this has another scale: drift bends maps, and stretches a
/// building by less.
const MOST_STRETCH: f64 = 0.02;

/// Share of a call that its method takes; the rest is what the maps say about the answer.
const SEARCH: f64 = 0.85;

fn searching(progress: &dyn Progress) -> Stage<'_> {
    Stage::new(progress, 0.0, SEARCH)
}

impl PairReport {
    /// What was found by the maps alone.
    fn of_match(found: MatchReport, seed: u64) -> Self {
        let best = found.hypotheses.first();
        let stretch = best.map(|best| [best.bend.stretch.x, best.bend.stretch.y]);
        let stretched = stretch
            .filter(|stretch| stretch.iter().any(|share| share.abs() > MOST_STRETCH))
            .map(|stretch| Warning::Stretched { stretch });
        Self {
            method: Method::Match,
            seed,
            outcome: found.outcome.clone(),
            target_from_source: best.map(|best| best.pose.target_from_source),
            overlap: best.map(|best| best.overlap),
            agreement: best.map(|best| best.agreement),
            hypotheses: found.hypotheses.iter().map(Hypothesis::from).collect(),
            warnings: stretched.into_iter().collect(),
            stages: Stages { matching: Some(found), ..Stages::default() },
        }
    }
}

/// What every method is given.
#[derive(Debug, Clone, Copy)]
struct Pair<'a> {
    target: &'a RobotMap<'a>,
    source: &'a RobotMap<'a>,
    params: &'a AlignParams,
}

impl Pair<'_> {
    fn by_what_there_is(&self, progress: &dyn Progress) -> Result<PairReport, MergeError> {
        if self.target.tags.is_empty() && self.source.tags.is_empty() {
            return self.by_maps(progress);
        }
        let common = common_tags(self.target.tags, self.source.tags)?;
        let lacking = select_tags(&common, &self.params.rfid.selection)?.refusal().cloned();
        let (refusal, tags) = match lacking {
            Some(lacking) => (lacking, None),
            None => {
                let by_tags = self.by_tags(TagMethod::Rfid3, &Stage::new(progress, 0.0, 0.6))?;
                match by_tags.outcome {
                    Outcome::Refused(refusal) => (refusal, by_tags.stages.tags),
                    Outcome::Found(_) => {
                        let mut report = by_tags;
                        let unused = self.params.prior.map(|_| Warning::PriorUnused);
                        report.warnings.extend(unused);
                        return Ok(report);
                    }
                }
            }
        };
        let mut report = self.by_maps(&Stage::new(progress, 0.6, 1.0))?;
        report.warnings.insert(0, Warning::WithoutTags(refusal));
        report.stages.tags = tags;
        Ok(report)
    }

    fn by_maps(&self, progress: &dyn Progress) -> Result<PairReport, MergeError> {
        let at_identity = || Prior {
            target_from_source: Se2::identity(),
            sigma_m: self.target.map.frame().resolution(),
            sigma_rad: 0.5_f64.to_radians(),
        };
        let prior = self.params.prior.or_else(|| self.are_copies().then(at_identity));
        let matching = MatchParams { prior, ..self.params.matching.clone() };
        let found = match_maps(self.target.map, self.source.map, &matching, progress)?;
        Ok(PairReport::of_match(found, self.params.seed))
    }

    fn by_tags(
        &self,
        method: TagMethod,
        progress: &dyn Progress,
    ) -> Result<PairReport, MergeError> {
        let given = &self.params.rfid;
        let lines = line_ransac::Params { seed: self.params.seed, ..given.lines.clone() };
        let params = RfidParams { lines, ..given.clone() };
        let found = align_by_tags(method, self.target, self.source, &params, &searching(progress))?;
        let best = match &found.outcome {
            Outcome::Found(target_from_source) => Some(*target_from_source),
            Outcome::Refused(_) => found.evidence.start_target_from_source,
        };
        let warnings = found.evidence.warnings();
        let stages = Stages { tags: Some(found.evidence), ..Stages::default() };
        let (report, _) =
            self.scored(Method::Tags(method), found.outcome, best, stages, progress)?;
        Ok(PairReport { warnings, ..report })
    }

    /// A walk always ends somewhere: refused unless the maps make that likelier right than wrong.
    fn by_walk(&self, progress: &dyn Progress) -> Result<PairReport, MergeError> {
        let [target, source] = [self.target.map, self.source.map];
        let walks = walk_coarse_to_fine(target, source, self.params, &searching(progress))?;
        let outcome = walks.last().map_or(
            Outcome::Refused(Refusal::TooLittleStructure { have: 0, need: 1 }),
            |last| match &last.outcome {
                Outcome::Found(found) => Outcome::Found(found.target_from_source),
                Outcome::Refused(refusal) => Outcome::Refused(refusal.clone()),
            },
        );
        let best = outcome.clone().found();
        let stages = Stages { walks, ..Stages::default() };
        let (mut report, evidence) =
            self.scored(Method::Carpin, outcome, best, stages, progress)?;
        if let Some(evidence) = evidence.filter(|evidence| evidence.score() <= 0.0) {
            let conflict_m = evidence.near_miss_m + evidence.conflict_m;
            let compared_m = conflict_m + evidence.hit_m;
            let need_m = self.params.matching.min_wall_m;
            report.outcome = Outcome::Refused(if evidence.is_comparable() {
                Refusal::ConflictingWalls { conflict_m, compared_m }
            } else {
                Refusal::NoOverlap { have_m: evidence.same_side_m, need_m }
            });
        }
        Ok(report)
    }

    fn as_given(&self, progress: &dyn Progress) -> Result<PairReport, MergeError> {
        let prior = self.params.prior;
        let given = prior.map_or_else(Se2::identity, |prior| prior.target_from_source);
        given.check_finite()?;
        let stages = Stages::default();
        let outcome = Outcome::Found(given);
        let (mut report, evidence) =
            self.scored(Method::Known, outcome, Some(given), stages, progress)?;
        for hypothesis in &mut report.hypotheses {
            hypothesis.covariance = Some(Matrix3::zeros());
        }
        report.warnings.extend(match evidence {
            Some(evidence) if evidence.is_comparable() => {
                let agreement = evidence.agreement();
                (evidence.score() <= 0.0).then_some(Warning::GivenPoseDoubtful { agreement })
            }
            _ => Some(Warning::GivenPoseUnchecked),
        });
        Ok(report)
    }

    fn by_segments(&self, progress: &dyn Progress) -> Result<PairReport, MergeError> {
        let params = RadonParams { seed: self.params.seed, ..self.params.radon };
        let [target, source] = [self.target.map, self.source.map];
        let found = align_by_radon(target, source, &params, &searching(progress))?;
        let verified = found.candidates.iter().find(|candidate| candidate.verified);
        let best = match &found.outcome {
            Outcome::Found(target_from_source) => Some(*target_from_source),
            Outcome::Refused(_) => {
                verified.or(found.candidates.first()).map(Candidate::target_from_source)
            }
        };
        let outcome = found.outcome.clone();
        let stages = Stages { radon: Some(found), ..Stages::default() };
        Ok(self.scored(Method::Radon, outcome, best, stages, progress)?.0)
    }

    /// The report of a method that knows one transform at most, accepted or not, and no
    /// probability; and what the maps say about that transform.
    fn scored(
        &self,
        method: Method,
        outcome: Outcome<Se2>,
        target_from_source: Option<Se2>,
        stages: Stages,
        progress: &dyn Progress,
    ) -> Result<(PairReport, Option<Evidence>), MergeError> {
        let thresholds = &self.params.matching.thresholds;
        let maps = [self.target.map, self.source.map];
        let scoring = Stage::new(progress, SEARCH, 1.0);
        let scored = target_from_source
            .map(|pose| Hypothesis::scored(maps, pose, thresholds, &scoring))
            .transpose()?;
        let (hypothesis, evidence) = scored.unzip();
        let report = PairReport {
            method,
            seed: self.params.seed,
            outcome,
            target_from_source,
            overlap: evidence.map(|evidence| evidence.overlap),
            agreement: evidence.map(|evidence| evidence.agreement()),
            hypotheses: hypothesis.into_iter().collect(),
            warnings: Vec::new(),
            stages,
        };
        Ok((report, evidence))
    }

    fn readings_dropped(&self) -> Option<Warning> {
        let tags = || self.target.tags.iter().chain(self.source.tags);
        let dropped: usize = tags().map(|tag| tag.dropped).sum();
        let used: usize = tags().map(|tag| tag.readings).sum();
        (dropped > 0).then_some(Warning::ReadingsDropped { dropped, readings: used + dropped })
    }

    fn are_copies(&self) -> bool {
        self.target.map == self.source.map
    }
}
