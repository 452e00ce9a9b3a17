//! All blocks in a row, over every pair of segments.

use ogm_core::{Cancelled, Grid, OccupancyGrid, Outcome, Progress, Refusal, Se2, Stage, Steps};

use crate::approximate::box_centre;
use crate::hypotheses::{Apart, Rotations, distinct, propose};
use crate::parallel::map_in_order;
use crate::pose_scorer::{PoseScorer, Sampling};
use crate::verify::{WallField, verify_prepared};
use crate::{
    Hypothesis, HypothesisParams, RadonError, RadonImage, RadonParams, RotationCorrelation,
    TranslationWindow, Verification, VerificationParams, WallSegment, detect_edges,
    distinctive_segments, radon, smooth_edges, tune_translation,
};

/// What was found, and what every block saw on the way.
#[derive(Debug, Clone)]
pub struct RadonMatch {
    /// Edges, segments and Radon image of the target, then of the source; absent where a map has
    /// no walls at all.
    pub maps: Option<[MapStages; 2]>,
    /// Pairs of segments that were compared.
    pub compared: usize,
    /// Poses that were scored.
    pub hypotheses: usize,
    /// The best distinct poses, tuned and verified, the best hypothesis first.
    pub candidates: Vec<Candidate>,
    /// Which of the candidates was accepted.
    pub accepted: Option<usize>,
    /// The transform that maps points of the source map into the target map, or why there is none.
    pub outcome: Outcome<Se2>,
}

/// What the blocks made of one map.
#[derive(Debug, Clone)]
pub struct MapStages {
    /// Canny edges of the occupied cells.
    pub edges: Grid<bool>,
    /// With both sides of a wall made one line.
    pub smoothed: Grid<bool>,
    /// Segments worth comparing.
    pub segments: Vec<WallSegment>,
    /// Radon transform of the occupied cells.
    pub radon: RadonImage,
}

/// A pose that went through all blocks.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The best of the hypotheses at this pose; its order is that of the first.
    pub hypothesis: Hypothesis,
    /// How many promising hypotheses lie near.
    pub support: usize,
    /// The translation's window, the last if it had to move.
    pub window: TranslationWindow,
    /// What the maps say about the tuned transform.
    pub verification: Verification,
    /// Whether that is enough.
    pub verified: bool,
}

impl Candidate {
    /// The tuned transform.
    #[must_use]
    pub fn target_from_source(&self) -> Se2 {
        self.window.target_from_source
    }
}

/// Windows that a translation may move on to when the best shift lies at the rim.
const MAX_WINDOWS: usize = 4;

/// Shares of the work after which the walls of both maps are found, and the blocks of the target
/// and then of the source are through.
const PREPARED: [f64; 3] = [0.02, 0.08, 0.15];

/// Share of the work after which all poses are proposed.
const PROPOSED: f64 = 0.9;

/// Finds the transform that maps points of `source` into the frame of `target` by segments of
/// walls that look alike, tuned by the Radon transform and by the similarity of the maps, and
/// verified (Saeedi et al., Fig. 1).
///
/// Every hypothesis of a pair of segments is scored by its walls, the best go through the later
/// blocks, and those that pass the verification are left. If they do not agree, each is as likely
/// as the others and the answer is [`Refusal::SeveralVerified`]; a map without distinctive segments is
/// refused, too. Equal input and seed give equal bits on any number of threads.
///
/// # Errors
/// Maps of different resolution, a parameter out of range, or [`RadonError::Cancelled`].
pub fn find_transform(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    params: &RadonParams,
    progress: &dyn Progress,
) -> Result<RadonMatch, RadonError> {
    let found = search(target, source, params, progress)?;
    progress.report(1.0);
    Ok(found)
}

fn search(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    params: &RadonParams,
    progress: &dyn Progress,
) -> Result<RadonMatch, RadonError> {
    params.check()?;
    progress.go_on(0.0)?;
    target.check_same_resolution(source)?;
    let thresholds = &params.thresholds;
    let fields = [target, source].map(|map| WallField::new(map, thresholds));
    let [Some(target_walls), Some(source_walls)] = fields else {
        return Ok(RadonMatch {
            maps: None,
            compared: 0,
            hypotheses: 0,
            candidates: Vec::new(),
            accepted: None,
            outcome: Outcome::Refused(Refusal::TooLittleStructure { have: 0, need: 1 }),
        });
    };
    progress.go_on(PREPARED[0])?;
    let target_stages = stages(&target_walls, 0, params)?;
    progress.go_on(PREPARED[1])?;
    let maps = [target_stages, stages(&source_walls, 1, params)?];
    progress.go_on(PREPARED[2])?;
    let correlation = RotationCorrelation::between(&maps[0].radon, &maps[1].radon)?;
    let HypothesisParams { reach, samples, .. } = params.hypotheses;
    let sampling = Sampling { reach, samples };
    let proposals = propose(
        [&maps[0].segments, &maps[1].segments],
        &Rotations::new(&correlation, params.rotation.window),
        &PoseScorer::new(&target_walls, &source_walls, thresholds, &sampling),
        &params.hypotheses,
        &params.distinctive,
        &Stage::new(progress, PREPARED[2], PROPOSED),
    )?;

    let cell = target.frame().resolution();
    let centre = box_centre(&source_walls.walls);
    let window = params.translation.radius as f64 * cell;
    let hypotheses = distinct(
        &proposals.promising,
        centre,
        &Apart { distance: window, angle: 3.0_f64.to_radians() },
        params.hypotheses.max_candidates,
    );
    let tuned = Stage::new(progress, PROPOSED, 1.0);
    let tuned = Steps::new(&tuned, hypotheses.len());
    let candidates = map_in_order(&hypotheses, |_, &(hypothesis, support)| {
        let window = tune(target, source, &hypothesis, params, progress)?;
        let verification = verify_prepared(&target_walls, &source_walls, &window);
        let inside = !window.is_at_rim();
        let verified = inside && verification.is_accepted(&params.verification);
        tuned.step()?;
        Ok(Candidate { hypothesis, support, window, verification, verified })
    });
    let candidates: Vec<Candidate> = candidates.into_iter().collect::<Result<_, RadonError>>()?;

    let apart = Apart { distance: 4.0 * cell, angle: 2.0_f64.to_radians() };
    let choice = choose(&candidates, &params.verification, |a, b| {
        apart.are(&a.target_from_source(), &b.target_from_source(), centre)
    });
    let outcome = match &choice {
        Ok(index) => Outcome::Found(candidates[*index].target_from_source()),
        Err(Some(refusal)) => Outcome::Refused(refusal.clone()),
        Err(None) => Outcome::Refused(Refusal::NoAlikeSegments { compared: proposals.compared }),
    };
    Ok(RadonMatch {
        maps: Some(maps),
        compared: proposals.compared,
        hypotheses: proposals.scored,
        candidates,
        accepted: choice.ok(),
        outcome,
    })
}

/// Edges, segments and Radon image of a map.
fn stages(
    walls: &WallField<'_>,
    stream: u64,
    params: &RadonParams,
) -> Result<MapStages, RadonError> {
    let map = walls.map;
    let edges = detect_edges(map, &params.thresholds, &params.edges)?;
    let smoothed = smooth_edges(&edges, params.max_gap);
    let segments = distinctive_segments(
        &smoothed,
        map.frame(),
        params.seed.wrapping_mul(2).wrapping_add(stream),
        &params.segments,
        &params.distinctive,
    )?;
    let image = radon(&walls.walls, map.frame().resolution(), params.rotation.angle_step)?;
    let radon = image.expect("a wall field has a wall");
    Ok(MapStages { edges, smoothed, segments, radon })
}

/// The translation tuned in windows that follow the best shift.
fn tune(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    hypothesis: &Hypothesis,
    params: &RadonParams,
    progress: &dyn Progress,
) -> Result<TranslationWindow, RadonError> {
    let mut start_target_from_source = hypothesis.turned_target_from_source;
    let mut windows = 0;
    loop {
        if progress.is_cancelled() {
            return Err(RadonError::Cancelled(Cancelled));
        }
        let window = tune_translation(
            target,
            source,
            start_target_from_source,
            &params.thresholds,
            &params.translation,
        )?;
        windows += 1;
        if !window.is_at_rim() || windows == MAX_WINDOWS {
            return Ok(window);
        }
        start_target_from_source = window.target_from_source;
    }
}

/// The verified candidate, if there is one and no other contradicts it; else why not.
fn choose(
    candidates: &[Candidate],
    params: &VerificationParams,
    apart: impl Fn(&Candidate, &Candidate) -> bool,
) -> Result<usize, Option<Refusal>> {
    let agreement = |candidate: &Candidate| {
        let counts = candidate.verification.counts;
        counts.agreement() as f64 - counts.disagreement() as f64
    };
    let mut best: Option<usize> = None;
    for (index, candidate) in candidates.iter().enumerate().filter(|(_, one)| one.verified) {
        if best.is_none_or(|best| agreement(candidate) > agreement(&candidates[best])) {
            best = Some(index);
        }
    }
    let Some(best) = best else {
        return Err(candidates.first().map(|first| refusal_of(first, params)));
    };
    let rivals = candidates.iter().filter(|one| one.verified && apart(one, &candidates[best]));
    match rivals.count() {
        0 => Ok(best),
        others => Err(Some(Refusal::SeveralVerified { poses: others + 1 })),
    }
}

/// What the best hypothesis failed by.
fn refusal_of(candidate: &Candidate, params: &VerificationParams) -> Refusal {
    let at_the_rim = Refusal::AtTheRim { radius: candidate.window.counts.width() / 2 };
    candidate.verification.refusal(params).unwrap_or(at_the_rim)
}
