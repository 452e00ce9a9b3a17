//! How two groups of maps may lie on each other, by what all of their walls say together.

use grid_match::{Evidence, PreparedMap, pose_probabilities, score_pose};
use nalgebra::Point2;
use ogm_core::{Se2, wrap_angle};

use crate::MergeError;
use crate::part::Part;
use crate::team_pairs::Matched;

/// Poses further apart than this at the centre of the second group are different answers, metres
/// and radians.
const APART: (f64, f64) = (0.75, 0.1);
/// Most distinct poses that are scored.
const MOST_POSES: usize = 8;
/// A pair's hypothesis with a lower score says nothing.
const LEAST_SCORE: f64 = -8.0;
/// Wall in free space that contradicts a pose, metres, and as a share of the wall compared: one
/// pair of a group may veto what all others want.
const VETO_M: f64 = 2.0;
const VETO_SHARE: f64 = 0.35;

/// The best way to join two groups.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    pub(crate) first_from_second: Se2,
    pub(crate) probability: f64,
    pub(crate) score: f64,
}

/// What links are made of.
pub(crate) struct Evidences<'a> {
    pub(crate) prepared: &'a [PreparedMap],
    pub(crate) pairs: &'a [Matched],
    pub(crate) repeats: bool,
}

impl Evidences<'_> {
    /// The best link of two groups; `None` where no pair proposes one.
    pub(crate) fn link(&self, first: &Part, second: &Part) -> Result<Option<Link>, MergeError> {
        let mut poses = self.poses(first, second);
        if first.is_alone() && second.is_alone() {
            return Ok(poses.first().map(|&(score, first_from_second, probability)| Link {
                first_from_second,
                probability,
                score,
            }));
        }
        let [whole, other] = [first, second].map(|part| part.whole(self.prepared));
        for (score, first_from_second, _) in &mut poses {
            *score = score_pose(whole, other, first_from_second)?.score();
        }
        poses.sort_by(|a, b| b.0.total_cmp(&a.0));
        let scores: Vec<f64> = poses.iter().map(|(score, _, _)| *score).collect();
        let probabilities = pose_probabilities(&scores, self.repeats);
        let best = poses.first().zip(probabilities.first());
        Ok(best.map(|(&(score, first_from_second, _), &probability)| Link {
            first_from_second,
            probability,
            score,
        }))
    }

    /// Whether some pair of maps across the groups contradicts their link.
    pub(crate) fn is_vetoed(
        &self,
        first: &Part,
        second: &Part,
        first_from_second: &Se2,
    ) -> Result<bool, MergeError> {
        for &(a, first_from_a) in &first.members {
            for &(b, second_from_b) in &second.members {
                let a_from_b = first_from_a.between(&(*first_from_second * second_from_b));
                let evidence = score_pose(&self.prepared[a], &self.prepared[b], &a_from_b)?;
                if contradicts(&evidence) {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Distinct poses that pairs across the groups propose, best first: score, pose, probability by
    /// the pair alone.
    fn poses(&self, first: &Part, second: &Part) -> Vec<(f64, Se2, f64)> {
        let mut proposed = Vec::new();
        for pair in self.pairs {
            let forth = first.pose(pair.target).zip(second.pose(pair.source));
            let back = first.pose(pair.source).zip(second.pose(pair.target));
            for proposal in pair.proposals.iter().filter(|found| found.score > LEAST_SCORE) {
                let pose = proposal.pose.target_from_source;
                let first_from_second = match (forth, back) {
                    (Some((first_from_a, second_from_b)), _) => {
                        first_from_a * pose * second_from_b.inverse()
                    }
                    (_, Some((first_from_b, second_from_a))) => {
                        first_from_b * pose.inverse() * second_from_a.inverse()
                    }
                    _ => continue,
                };
                proposed.push((proposal.score, first_from_second, proposal.pose.probability));
            }
        }
        proposed.sort_by(|a, b| b.0.total_cmp(&a.0));
        let centre = second.centre(self.prepared);
        let mut distinct: Vec<(f64, Se2, f64)> = Vec::new();
        for found in proposed {
            if distinct.len() < MOST_POSES
                && distinct.iter().all(|other| is_apart(&found.1, &other.1, centre))
            {
                distinct.push(found);
            }
        }
        distinct
    }
}

/// Whether two poses are two answers.
fn is_apart(a: &Se2, b: &Se2, centre: Point2<f64>) -> bool {
    let turn = wrap_angle(a.theta() - b.theta()).abs();
    turn > APART.1 || (*a * centre - *b * centre).norm() > APART.0
}

fn contradicts(evidence: &Evidence) -> bool {
    let walls = &evidence.relaxed;
    evidence.is_comparable()
        && walls.conflict_m > VETO_M + VETO_SHARE * (walls.hit_m + walls.near_miss_m)
}
