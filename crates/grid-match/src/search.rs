//! The tiers of a search, from candidates to scored poses.

use ogm_core::{Cancelled, Progress, Se2, Stage, Steps};

use crate::bounds::Bounds;
use crate::evaluate::{evaluate, evaluate_rigid};
use crate::evidence::Evidence;
use crate::parallel::each;
use crate::params::Effort;
use crate::prepare::PreparedMap;
use crate::refine::{Points, Sides, refine};
use crate::relax::{MovedPatch, relax};
use crate::rotation;
use crate::translation::{Candidate, CoarsePair, distinct};
use crate::wall_counts::Reach;
use crate::work::Work;

/// Scales of the first refinement, metres at a coarse cell of 0.2 m.
const COARSE_SCALES: [f64; 5] = [0.5, 0.35, 0.25, 0.2, 0.15];
/// Wall points of each map in it.
const COARSE_POINTS: usize = 400;
/// Scales of the last refinement, metres, none below a cell.
const FINE_SCALES: [f64; 5] = [0.2, 0.14, 0.1, 0.08, 0.08];
/// Wall points of each map in it, and in the score that ranks what it ends in.
pub(crate) const FINE_POINTS: usize = 1000;
/// Wall points of each map in the score that is reported.
const ALL_POINTS: usize = 3000;
/// A pose whose score is so far below that of the best is not looked at any closer, nor listed; a
/// closer look at the poses of real pairs raised no score by more than five.
pub(crate) const OUT_OF_SIGHT: f64 = 12.0;
/// Rotations by the two strongest peaks of the spectra, mostly those along and across the walls.
const STRONGEST: usize = 4;
/// How far to both sides of these, radians: 0.9°. Half of it moves a wall at the rim of the largest
/// lattice by less than three coarse cells, and most walls by one.
const BESIDE: f64 = 0.0157;
/// Refined candidates closer than this are one, metres and radians.
const SAME: (f64, f64) = (0.3, 0.04);

/// A pose and all that is known about it.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) first_from_second: Se2,
    pub(crate) evidence: Evidence,
    pub(crate) score: f64,
    /// The parts of the second map on the first.
    pub(crate) patches: Vec<MovedPatch>,
}

/// What a tier tries.
struct Tier {
    rotations: Vec<f64>,
    candidates: usize,
    survivors: usize,
}

impl Tier {
    /// About what correlating, refining and evaluating cost beside each other: a rotation and its
    /// half turn cost as much as two survivors or 25 candidates.
    fn costs(&self) -> [f64; 3] {
        let count = rotation::by_half_turns(&self.rotations).len().max(1);
        [count as f64, 0.04 * self.candidates as f64, 0.5 * self.survivors as f64]
    }
}

/// Two maps and what bounds their match.
pub(crate) struct Search<'a> {
    first: &'a PreparedMap,
    second: &'a PreparedMap,
    coarse: CoarsePair<'a>,
    bounds: Option<Bounds>,
    suggested: Vec<f64>,
    /// So many of these, from the first on, are worth rotations to both sides of them.
    closely: usize,
    pub(crate) work: Work,
    pub(crate) fits: Vec<Fit>,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        first: &'a PreparedMap,
        second: &'a PreparedMap,
        bounds: Option<Bounds>,
        work: Work,
    ) -> Self {
        let coarse = CoarsePair::new(first, second);
        let mut suggested = rotation::by_spectrum(&first.spectrum, &second.spectrum, 4);
        if let Some(bounds) = &bounds {
            suggested.retain(|&theta| bounds.allows_rotation(theta));
            suggested.extend(bounds.rotations());
        }
        let mut closely = suggested.len();
        if suggested.is_empty() {
            suggested = rotation::sweep();
            closely = suggested.len();
        } else if bounds.is_none() {
            closely = closely.min(STRONGEST);
        }
        Self { first, second, coarse, bounds, suggested, closely, work, fits: Vec::new() }
    }

    /// About how much a tier costs beside the others.
    pub(crate) fn cost(&self, effort: Effort) -> f64 {
        self.tier(effort).costs().iter().sum()
    }

    /// Runs one tier and adds what it finds to the fits.
    pub(crate) fn run(&mut self, effort: Effort, progress: &dyn Progress) -> Result<(), Cancelled> {
        let tier = self.tier(effort);
        let [correlate, refine, evaluate] = tier.costs();
        let whole = correlate + refine + evaluate;
        let (found, refined) = (correlate / whole, (correlate + refine) / whole);
        let mut candidates = self.coarse.candidates(
            &tier.rotations,
            tier.candidates,
            self.bounds.as_ref(),
            &mut self.work,
            &Stage::new(progress, 0.0, found),
        )?;
        if let Some(bounds) = self.bounds.filter(|_| effort == Effort::Fast) {
            let first_from_second = bounds.first_from_second;
            candidates.push(Candidate { first_from_second, score: 0.0 });
        }
        let rough = Stage::new(progress, found, refined);
        let promising = self.refine_roughly(candidates, tier.survivors, &rough)?;
        self.refine_and_evaluate(&promising, &Stage::new(progress, refined, 1.0))
    }

    fn tier(&self, effort: Effort) -> Tier {
        match effort {
            Effort::Fast => {
                Tier { rotations: self.suggested.clone(), candidates: 40, survivors: 8 }
            }
            Effort::Standard => {
                let rotations = rotation::beside(&self.suggested[..self.closely], BESIDE);
                Tier { rotations, candidates: 30, survivors: 5 }
            }
            Effort::Thorough => {
                let mut rotations = rotation::sweep();
                if let Some(bounds) = &self.bounds {
                    rotations.retain(|&theta| bounds.allows_rotation(theta));
                }
                Tier { rotations, candidates: 150, survivors: 24 }
            }
        }
    }

    /// Lets candidates follow the walls and keeps the `most` that then fit best.
    fn refine_roughly(
        &mut self,
        candidates: Vec<Candidate>,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Vec<Candidate>, Cancelled> {
        let done = Steps::new(progress, candidates.len());
        let ratio = self.coarse.cell / 0.2;
        let scales = COARSE_SCALES.map(|scale| scale * ratio);
        let reach = self.reach();
        let points = Points { most: COARSE_POINTS, sides: Sides::Any };
        let cost = 2 * COARSE_POINTS * (scales.len() + 1);
        let allowed = candidates.iter().take_while(|_| self.work.spend_points(cost)).count();
        let (first, second) = (self.first, self.second);
        let mut refined = each(&candidates[..allowed], |candidate| {
            let start_first_from_second = candidate.first_from_second;
            let first_from_second = refine(first, second, start_first_from_second, &scales, points);
            let evidence = evaluate_rigid(first, second, &first_from_second, reach, COARSE_POINTS);
            done.step().map(|()| Candidate { first_from_second, score: evidence.rough_score() })
        })?;
        refined.sort_by(|a, b| b.score.total_cmp(&a.score));
        let is_inside = |candidate: &&Candidate| {
            self.bounds.is_none_or(|bounds| bounds.contains(&candidate.first_from_second))
        };
        let best = refined.iter().find(is_inside).map_or(f64::NEG_INFINITY, |best| best.score);
        refined.retain(|candidate| candidate.score > best - OUT_OF_SIGHT);
        Ok(distinct(refined, self.second.centre, SAME.0, SAME.1, most))
    }

    /// Refines and scores the promising poses in full.
    fn refine_and_evaluate(
        &mut self,
        promising: &[Candidate],
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let done = Steps::new(progress, promising.len());
        let scales = FINE_SCALES.map(|scale| scale.max(self.resolution()));
        let points =
            self.first.walls.len().min(FINE_POINTS) + self.second.walls.len().min(FINE_POINTS);
        let used = Points { most: FINE_POINTS, sides: Sides::NotOpposite };
        let cost = points * (scales.len() + 1);
        let allowed = promising.iter().take_while(|_| self.work.spend_points(cost)).count();
        let (first, second, bounds) = (self.first, self.second, self.bounds);
        let fits = each(&promising[..allowed], |candidate| {
            let start_first_from_second = candidate.first_from_second;
            let first_from_second = refine(first, second, start_first_from_second, &scales, used);
            let is_inside = bounds.is_none_or(|bounds| bounds.contains(&first_from_second));
            let fit = is_inside.then(|| Fit::of(first, second, first_from_second, FINE_POINTS));
            done.step().map(|()| fit)
        })?;
        self.fits.extend(fits.into_iter().flatten());
        Ok(())
    }

    fn reach(&self) -> Reach {
        Reach::at(self.resolution())
    }

    fn resolution(&self) -> f64 {
        self.first.resolution().max(self.second.resolution())
    }
}

/// All that two maps say about a pose.
pub(crate) fn evaluate_in_full(
    first: &PreparedMap,
    second: &PreparedMap,
    first_from_second: Se2,
) -> Fit {
    Fit::of(first, second, first_from_second, ALL_POINTS)
}

/// Where the parts of the second map went, by all of its walls: how maps are bent shows in places,
/// and of a large map some have too few of the points of a score. `None` of a map that has no more.
pub(crate) fn moved_in_full(
    first: &PreparedMap,
    second: &PreparedMap,
    fit: &Fit,
) -> Option<Vec<MovedPatch>> {
    let walls = second.walls.len();
    let reach = Reach::at(first.resolution().max(second.resolution()));
    let relaxed = || relax(second, first, &fit.first_from_second, reach, walls).patches;
    (walls > ALL_POINTS).then(relaxed)
}

impl Fit {
    /// On at most `most` wall points of each map.
    fn of(first: &PreparedMap, second: &PreparedMap, first_from_second: Se2, most: usize) -> Self {
        let reach = Reach::at(first.resolution().max(second.resolution()));
        let (evidence, patches) = evaluate(first, second, &first_from_second, reach, most);
        Self { first_from_second, evidence, score: evidence.score(), patches }
    }
}
