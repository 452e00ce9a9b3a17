//! Many poses from pairs of segments, each scored by how walls meet, and the best of them.

use nalgebra::Point2;
use ogm_core::{Cancelled, ParameterError, Progress, Se2, Steps, require, wrap_angle, wrap_period};
use std::f64::consts::PI;

use crate::approximate::{Line, PoseRule, pose_between};
use crate::correlation::{dot, histogram_correlations};
use crate::parallel::map_in_order;
use crate::pose_scorer::PoseScorer;
use crate::{DistinctiveParams, RotationCorrelation, WallSegment};

/// How poses are proposed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HypothesisParams {
    /// Least correlation of two segments, in all four senses; the paper wants "close to one".
    pub min_correlation: f64,
    /// Most poses to scorer.
    pub max_hypotheses: usize,
    /// Walls that are this near to one of the other map meet it, cells.
    pub reach: f64,
    /// Most walls of a map that a pose is scored by.
    pub samples: usize,
    /// Most distinct poses that go on to the translation.
    pub max_candidates: usize,
}

impl Default for HypothesisParams {
    fn default() -> Self {
        Self {
            min_correlation: 0.9,
            max_hypotheses: 300_000,
            reach: 3.0,
            samples: 250,
            max_candidates: 16,
        }
    }
}

impl HypothesisParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let least = self.min_correlation;
        let name = "hypotheses.min_correlation";
        require((-1.0..=1.0).contains(&least), name, "-1 to 1", least)?;
        let reach_ok = self.reach >= 0.0 && self.reach <= 1000.0;
        require(reach_ok, "hypotheses.reach", "0 to 1000 cells", self.reach)?;
        let samples = self.samples as f64;
        require(self.samples > 0, "hypotheses.samples", "at least 1", samples)
    }
}

/// A pose that two segments of like shape propose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hypothesis {
    /// Which segment of the target.
    pub target_segment: usize,
    /// Which segment of the source.
    pub source_segment: usize,
    /// By the lines and means of the segments.
    pub approximate_target_from_source: Se2,
    /// With the rotation tuned.
    pub turned_target_from_source: Se2,
    /// Share of sampled walls that meet a wall of the other map, less those that fall on its free
    /// space; both directions. 1 is full agreement.
    pub score: f64,
    /// How many hypotheses were scored before.
    pub order: usize,
}

/// All that were scored.
#[derive(Debug)]
pub(crate) struct Proposals {
    /// The better ones, in the order in which they were scored.
    pub(crate) promising: Vec<Hypothesis>,
    /// Pairs of segments that were compared.
    pub(crate) compared: usize,
    /// Poses that were scored.
    pub(crate) scored: usize,
}

/// Poses below this score are counted and forgotten.
const PROMISING: f64 = 0.1;

/// Target segments that are compared before the budget is looked at.
const BLOCK: usize = 32;

/// Compares every segment of the target with every one of the source, until the budget is spent,
/// and scores the pose of each pair that is alike.
pub(crate) fn propose(
    segments: [&[WallSegment]; 2],
    rotation: &Rotations,
    scorer: &PoseScorer,
    params: &HypothesisParams,
    distinctive: &DistinctiveParams,
    progress: &dyn Progress,
) -> Result<Proposals, Cancelled> {
    let [target, source] = segments.map(|segments| {
        let shapes = segments.iter().map(Shape::new);
        shapes.collect::<Vec<Option<Shape<'_>>>>()
    });
    let done = Steps::new(progress, target.len());
    let mut all = Proposals { promising: Vec::new(), compared: 0, scored: 0 };
    for (block, targets) in target.chunks(BLOCK).enumerate() {
        if all.scored >= params.max_hypotheses {
            break;
        }
        let scored = map_in_order(targets, |offset, target| -> Result<_, Cancelled> {
            let mut scored = Vec::new();
            for (source_segment, source) in source.iter().enumerate() {
                let (Some(target), Some(source)) = (target, source) else { continue };
                if !target.is_like(source, params.min_correlation, distinctive) {
                    continue;
                }
                let approximate_target_from_source =
                    pose_between(&target.line, &source.line, PoseRule::Corrected);
                let theta = rotation.tuned(approximate_target_from_source.theta());
                let turned = Se2::new(0.0, 0.0, theta);
                let translation = target.line.mean - turned * source.line.mean;
                let turned_target_from_source = Se2::new(translation.x, translation.y, theta);
                scored.push(Hypothesis {
                    target_segment: block * BLOCK + offset,
                    source_segment,
                    approximate_target_from_source,
                    turned_target_from_source,
                    score: scorer.score(&turned_target_from_source),
                    order: 0,
                });
            }
            done.step()?;
            Ok(scored)
        });
        all.compared += targets.len() * source.len();
        for scored in scored {
            for mut hypothesis in scored? {
                hypothesis.order = all.scored;
                all.scored += 1;
                if hypothesis.score > PROMISING {
                    all.promising.push(hypothesis);
                }
            }
        }
    }
    Ok(all)
}

/// A segment, ready to be compared with many.
struct Shape<'a> {
    segment: &'a WallSegment,
    line: Line,
    /// Of unit length.
    distance: Vec<f64>,
    /// Of unit length.
    arc: Vec<f64>,
}

impl<'a> Shape<'a> {
    fn new(segment: &'a WallSegment) -> Option<Self> {
        let unit = |values: &[f64]| {
            let norm = dot(values, values).sqrt();
            (norm > 0.0).then(|| values.iter().map(|value| value / norm).collect())
        };
        Some(Self {
            segment,
            line: Line::fit(&segment.points)?,
            distance: unit(&segment.signature.distance)?,
            arc: unit(&segment.signature.arc)?,
        })
    }

    /// Whether all four correlations of [`correlate`](crate::correlate) reach `least`; the
    /// vectors first, which cost least and rule out most.
    fn is_like(&self, other: &Self, least: f64, params: &DistinctiveParams) -> bool {
        dot(&self.arc, &other.arc) >= least
            && dot(&self.distance, &other.distance) >= least
            && histogram_correlations(&self.segment.signature, &other.segment.signature, params)
                .iter()
                .all(|&correlation| correlation >= least)
    }
}

/// Tuned rotations, looked up.
#[derive(Debug)]
pub(crate) struct Rotations {
    /// Correction at every step of half a turn.
    corrections: Vec<f64>,
    step: f64,
}

impl Rotations {
    pub(crate) fn new(correlation: &RotationCorrelation, window: f64) -> Self {
        let step = correlation.angle_step;
        let at = |index: usize| correlation.correction(index as f64 * step, window);
        Self { corrections: (0..correlation.values.len()).map(at).collect(), step }
    }

    fn tuned(&self, rotation: f64) -> f64 {
        let count = self.corrections.len();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a half turn has a few hundred steps"
        )]
        let index = (rotation.rem_euclid(PI) / self.step).round() as usize % count.max(1);
        // The lookup is for the nearest step, not for `rotation` itself.
        let from_step = wrap_period(rotation - index as f64 * self.step, PI);
        wrap_angle(rotation - from_step + self.corrections.get(index).copied().unwrap_or(0.0))
    }
}

/// The best of `promising` that lie apart, best first, each with how many others lie near it.
pub(crate) fn distinct(
    promising: &[Hypothesis],
    centre: Point2<f64>,
    apart: &Apart,
    count: usize,
) -> Vec<(Hypothesis, usize)> {
    let mut order: Vec<usize> = (0..promising.len()).collect();
    order.sort_by(|&a, &b| promising[b].score.total_cmp(&promising[a].score));
    let mut kept: Vec<(Hypothesis, usize)> = Vec::new();
    for index in order {
        let one = promising[index];
        let pose_target_from_source = one.turned_target_from_source;
        let near = kept.iter().position(|(best, _)| {
            !apart.are(&best.turned_target_from_source, &pose_target_from_source, centre)
        });
        match near {
            Some(position) => {
                let (best, support) = &mut kept[position];
                *support += 1;
                best.order = best.order.min(one.order);
            }
            None if kept.len() < count => kept.push((one, 1)),
            None => {}
        }
    }
    kept
}

/// When two poses are not the same.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Apart {
    /// Metres at the middle of the source's walls.
    pub(crate) distance: f64,
    /// Radians.
    pub(crate) angle: f64,
}

impl Apart {
    pub(crate) fn are(
        &self,
        a_target_from_source: &Se2,
        b_target_from_source: &Se2,
        centre: Point2<f64>,
    ) -> bool {
        let (a, b) = (*a_target_from_source, *b_target_from_source);
        (a * centre - b * centre).norm() > self.distance
            || wrap_angle(a.theta() - b.theta()).abs() > self.angle
    }
}
