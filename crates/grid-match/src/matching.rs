//! The front door: two maps in, ranked poses or a refusal out.

use std::cmp::Ordering;

use ogm_core::{
    Cancelled, OccupancyGrid, Outcome, ParameterError, Progress, Refusal, RelativePose, Se2, Stage,
    Steps, require,
};

use crate::MatchError;
use crate::bend::bend;
use crate::bounds::Bounds;
use crate::confidence::{Beliefs, FLOOR, modes, probabilities};
use crate::covariance::{clusters, covariance};
use crate::evidence::Evidence;
use crate::parallel::{both, each};
use crate::params::{Effort, MatchParams};
use crate::prepare::PreparedMap;
use crate::refine::polish;
use crate::report::{Hypothesis, MatchReport};
use crate::score::NOT_COMPARABLE;
use crate::search::{Fit, OUT_OF_SIGHT, Search, evaluate_in_full, moved_in_full};
use crate::settle::settled;
use crate::weights::WEIGHTS;
use crate::work::Work;

/// Most hypotheses of a report.
const MOST_HYPOTHESES: usize = 5;
/// A pose is a rival of the best if it is at least so likely beside it, whatever its score.
const RIVAL_SHARE: f64 = 0.2;
/// A pose that is less likely is listed as the search left it: it is not polished, and its bend
/// rests on the walls of its score.
const WORTH_A_CLOSER_LOOK: f64 = 0.05;
/// Share of the work after which both maps are prepared.
const PREPARED: f64 = 0.2;
/// Share of the work after which all poses are found, but not polished.
const SEARCHED: f64 = 0.9;

/// Finds the rigid transform that lays `source` on `target`, from the maps alone.
///
/// The maps may differ in resolution, origin and yaw. The report ranks every pose that fits; its
/// outcome is the best if its probability reaches `params.accept`, and otherwise a refusal that
/// says what is missing: structure, overlap, agreement, or a lead over other poses.
///
/// # Errors
/// Parameters out of range, a prior that is not finite, or [`MatchError::Cancelled`].
pub fn match_maps(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    params: &MatchParams,
    progress: &dyn Progress,
) -> Result<MatchReport, MatchError> {
    params.check()?;
    // Each says only what it has done itself, for nobody knows which is ahead.
    let to_one = Stage::new(progress, 0.0, 0.5 * PREPARED);
    let to_end = Stage::new(progress, PREPARED, 1.0);
    let (target, source) = both(
        || PreparedMap::new(target, &params.thresholds, &to_one),
        || PreparedMap::new(source, &params.thresholds, &to_one),
    );
    match_prepared(&target?, &source?, params, &to_end)
}

/// [`match_maps`] for maps that were prepared before; the thresholds of `params` are not used.
///
/// # Errors
/// Parameters out of range, a prior that is not finite, or [`MatchError::Cancelled`].
pub fn match_prepared(
    target: &PreparedMap,
    source: &PreparedMap,
    params: &MatchParams,
    progress: &dyn Progress,
) -> Result<MatchReport, MatchError> {
    params.check()?;
    let report = search(target, source, params, progress)?;
    progress.report(1.0);
    Ok(report)
}

fn search(
    target: &PreparedMap,
    source: &PreparedMap,
    params: &MatchParams,
    progress: &dyn Progress,
) -> Result<MatchReport, Cancelled> {
    if let Some(refusal) = too_little(target, params).or_else(|| too_little(source, params)) {
        let outcome = Outcome::Refused(refusal);
        return Ok(MatchReport { hypotheses: Vec::new(), outcome, work: 0, exhausted: false });
    }
    // One order for both directions, so that swapping the maps inverts the answer exactly.
    let swapped = target.order(source) == Ordering::Less;
    let (first, second) = if swapped { (source, target) } else { (target, source) };
    let bounds = params.prior.map(|prior| Bounds::new(&prior, first, second, swapped));
    let beliefs = Beliefs {
        prior: bounds.map_or(0.0, |bounds| bounds.credit(first, second)),
        repeats: params.repeats,
    };
    let believed = |fits: &[Fit]| {
        let scores: Vec<f64> = fits.iter().map(|fit| fit.score).collect();
        probabilities(&scores, beliefs, &WEIGHTS)
    };
    let mut search = Search::new(first, second, bounds, Work::new(params.work_limit));
    let mut found = Vec::new();
    let efforts = [Effort::Fast, Effort::Standard, Effort::Thorough];
    let tiers: Vec<_> = efforts.into_iter().filter(|&effort| effort <= params.effort).collect();
    let searched = Stage::new(progress, 0.0, SEARCHED);
    let costs: Vec<f64> = tiers.iter().map(|&effort| search.cost(effort)).collect();
    let share =
        |tiers_done: usize| costs[..tiers_done].iter().sum::<f64>() / costs.iter().sum::<f64>();
    for (index, &effort) in tiers.iter().enumerate() {
        if search.work.exhausted() {
            break;
        }
        search.run(effort, &Stage::new(&searched, share(index), share(index + 1)))?;
        found = modes(search.fits.clone(), second.centre);
        if believed(&found).first().is_some_and(|&probability| probability >= params.accept) {
            break;
        }
    }
    let best = found.first().map_or(0.0, |fit| fit.score);
    found.retain(|fit| fit.score > best - OUT_OF_SIGHT);
    found.truncate(MOST_HYPOTHESES + 1);
    let polished = Stage::new(progress, SEARCHED, 1.0);
    let polished = Steps::new(&polished, found.len());
    let contains =
        |first_from_second: &Se2| bounds.is_none_or(|bounds| bounds.contains(first_from_second));
    let likely = believed(&found);
    let found: Vec<(Fit, f64)> = found.into_iter().zip(likely).collect();
    let found = each(&found, |(fit, probability)| {
        let start_first_from_second = fit.first_from_second;
        let is_worth_it = *probability >= WORTH_A_CLOSER_LOOK;
        let mut first_from_second = start_first_from_second;
        if is_worth_it {
            first_from_second = polish(first, second, start_first_from_second);
        }
        // What is reported is what was polished, so it is what has to be weighed and bounded.
        if !contains(&first_from_second) {
            first_from_second = start_first_from_second;
        }
        let mut fit = evaluate_in_full(first, second, first_from_second);
        if is_worth_it {
            fit = settled(first, second, fit, contains);
        }
        polished.step().map(|()| fit)
    })?;
    let mut found = modes(found, second.centre);
    found.retain(|fit| fit.score > NOT_COMPARABLE);
    let mut probabilities = believed(&found);
    probabilities.truncate(MOST_HYPOTHESES);
    let believed: Vec<(Fit, f64)> = found.into_iter().zip(probabilities).collect();
    let hypotheses = each(&believed, |(fit, probability)| {
        let first_from_second = hypothesis(first, second, fit, *probability);
        Ok(if swapped { first_from_second.inverse() } else { first_from_second })
    })?;
    let (work, exhausted) = (search.work.spent(), search.work.exhausted());
    let outcome = if exhausted {
        Outcome::Refused(Refusal::SearchCut { work })
    } else {
        outcome(&hypotheses, params)
    };
    Ok(MatchReport { hypotheses, outcome, work, exhausted })
}

/// What two maps say for and against one pose, without a search: what a report would say of it.
///
/// The same for the maps swapped and the pose inverted.
///
/// # Errors
/// A pose that is not finite.
pub fn score_pose(
    target: &PreparedMap,
    source: &PreparedMap,
    target_from_source: &Se2,
) -> Result<Evidence, MatchError> {
    target_from_source.check_finite()?;
    let target_local_from_source_local =
        target.map_from_local.inverse() * *target_from_source * source.map_from_local;
    let fit = if target.order(source) == Ordering::Less {
        evaluate_in_full(source, target, target_local_from_source_local.inverse())
    } else {
        evaluate_in_full(target, source, target_local_from_source_local)
    };
    Ok(fit.evidence)
}

fn too_little(map: &PreparedMap, params: &MatchParams) -> Option<Refusal> {
    let need = (params.min_wall_m / map.resolution()).ceil().max(1.0);
    let have = map.occupied_cells as f64;
    let metres = |cells: f64| cells * map.resolution();
    (have < need).then(|| Refusal::TooLittleWall { have_m: metres(have), need_m: metres(need) })
}

fn hypothesis(
    first: &PreparedMap,
    second: &PreparedMap,
    fit: &Fit,
    probability: f64,
) -> Hypothesis {
    let Fit { first_from_second, evidence, score, ref patches } = *fit;
    let scale = first.resolution().max(second.resolution()).max(0.08);
    let bend = || {
        let in_full = (probability >= WORTH_A_CLOSER_LOOK)
            .then(|| moved_in_full(first, second, fit))
            .flatten();
        bend(first, second, &first_from_second, in_full.as_ref().unwrap_or(patches))
    };
    let (bend, clusters) = both(bend, || clusters(first, second, &first_from_second, scale));
    let (covariance, weak_direction) =
        covariance(first, second, &first_from_second, &clusters, &bend);
    Hypothesis {
        pose: RelativePose {
            target_from_source: first.map_from_local
                * first_from_second
                * second.map_from_local.inverse(),
            covariance,
            probability,
        },
        score,
        weak_direction,
        overlap: evidence.overlap,
        agreement: evidence.agreement(),
        evidence,
        bend,
    }
}

fn outcome(hypotheses: &[Hypothesis], params: &MatchParams) -> Outcome<Se2> {
    let need_m = params.min_wall_m;
    let Some(best) = hypotheses.first() else {
        return Outcome::Refused(Refusal::NoOverlap { have_m: 0.0, need_m });
    };
    if best.pose.probability >= params.accept {
        return Outcome::Found(best.pose.target_from_source);
    }
    let is_rival = |other: &&Hypothesis| {
        other.score > FLOOR || other.pose.probability >= RIVAL_SHARE * best.pose.probability
    };
    let poses = hypotheses.iter().filter(is_rival).count();
    let evidence = &best.evidence;
    let against = evidence.near_miss_m + evidence.conflict_m;
    let (probability, need) = (best.pose.probability, params.accept);
    Outcome::Refused(if poses > 1 {
        Refusal::SeveralPoses { poses, probability, need }
    } else if against > evidence.hit_m * 0.35 {
        let compared_m = against + evidence.hit_m;
        Refusal::ConflictingWalls { conflict_m: against, compared_m }
    } else if evidence.hit_m < params.min_wall_m {
        Refusal::NoOverlap { have_m: evidence.hit_m, need_m }
    } else {
        Refusal::Unlikely { probability, need }
    })
}

impl MatchParams {
    fn check(&self) -> Result<(), MatchError> {
        let accept = self.accept;
        require(accept > 0.0 && accept <= 1.0, "accept", "above 0 and at most 1", accept)?;
        not_negative("min_wall_m", self.min_wall_m)?;
        if let Some(prior) = &self.prior {
            prior.target_from_source.check_finite()?;
            not_negative("prior.sigma_m", prior.sigma_m)?;
            not_negative("prior.sigma_rad", prior.sigma_rad)?;
        }
        Ok(())
    }
}

fn not_negative(name: &'static str, value: f64) -> Result<(), ParameterError> {
    require(value.is_finite() && value >= 0.0, name, "finite and not below 0", value)
}
