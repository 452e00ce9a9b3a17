//! How two groups of maps may lie on each other, by what all of their walls say together.

use grid_match::{Evidence, PreparedMap, WallFit, pose_probabilities, refine_pose, score_pose};
use nalgebra::Point2;
use ogm_core::{RelativePose, Se2, log_odds, probability_from_log_odds, wrap_angle};

use super::pairs::Matched;
use super::part::Part;
use crate::MergeError;

/// Poses further apart than this at the centre of the second group are different answers, metres
/// and radians.
const APART: (f64, f64) = (0.75, 0.1);
/// Most distinct poses that are scored.
const MOST_POSES: usize = 8;
/// A pair's hypothesis with a lower score says nothing.
const LEAST_SCORE: f64 = -8.0;
/// By how much all walls together must prefer a pose to every other, in log-odds, before it counts
/// how many pairs propose it, where another one fits well: where a building repeats, they all
/// propose the same alias, and the right pose is not far behind.
const LEAST_LEAD: f64 = 3.0;
/// Most score of another pose that does not fit well: bent maps laid together fit worse than any
/// two of them, so that pairs may know what all walls together do not.
const MOST_RIVAL: f64 = 2.0;
/// By how much another pose may then be preferred all the same, in log-odds.
const MOST_SHORT: f64 = 2.0;
/// Probability of the pair that is then heard, if another one agrees.
const SURE: f64 = 0.9;
/// Probability that the best pose of two maps of different places is given.
const OF_STRANGERS: f64 = 0.1;
/// Share of what another pair says that the surest does not say already.
const SHARED: f64 = 0.5;
/// No number of pairs makes a pose surer than this: of joins that many pairs ask for, so many are
/// right on simulated floors.
const MOST_BY_PAIRS: f64 = 0.995;
/// Wall of a map in free space of the other that contradicts a pose, metres, beside as much as lies
/// on wall or close to it: one pair of a group may veto what all others want.
const VETO_M: f64 = 5.0;

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
    /// In the order of their targets, then of their sources; target before source.
    pub(crate) pairs: &'a [Matched],
    pub(crate) repeats: bool,
}

impl Evidences<'_> {
    /// The best link of two groups; `None` where no pair proposes one.
    pub(crate) fn link(&self, first: &Part, second: &Part) -> Result<Option<Link>, MergeError> {
        let poses = self.poses(first, second);
        if first.is_alone() && second.is_alone() {
            return Ok(poses.first().map(|&(score, first_from_second, probability)| Link {
                first_from_second,
                probability,
                score,
            }));
        }
        let [whole, other] = [first, second].map(|part| part.whole(self.prepared));
        let centre = other.centre();
        let mut refined: Vec<(f64, Se2, f64)> = Vec::with_capacity(poses.len());
        for &(_, proposed_first_from_second, probability) in &poses {
            // What one pair of maps proposes is not yet where all of their walls fit best.
            let start = &proposed_first_from_second;
            let mut first_from_second = refine_pose(whole, other, start)?;
            if is_apart(&first_from_second, start, centre) {
                first_from_second = *start;
            }
            let score = score_pose(whole, other, &first_from_second)?.score();
            refined.push((score, first_from_second, probability));
        }
        refined.sort_by(|a, b| b.0.total_cmp(&a.0));
        let poses = distinct(refined, centre);
        let scores: Vec<f64> = poses.iter().map(|(score, _, _)| *score).collect();
        let by_walls = pose_probabilities(&scores, self.repeats);
        let links = poses.iter().zip(by_walls).enumerate().map(|(index, (found, by_walls))| {
            let &(score, first_from_second, _) = found;
            let others = scores.iter().enumerate().filter(|(other, _)| *other != index);
            let rival = others.map(|(_, score)| *score).fold(f64::NEG_INFINITY, f64::max);
            let said = self.said(first, second, &first_from_second);
            let is_ahead = score - rival >= LEAST_LEAD;
            let is_open = rival <= MOST_RIVAL && rival - score <= MOST_SHORT;
            let is_heard = is_ahead || is_open && is_witnessed(&said);
            let by_pairs = if is_heard && !self.repeats { agreement(&said) } else { 0.0 };
            Link { first_from_second, probability: by_walls.max(by_pairs), score }
        });
        Ok(links.reduce(|best, link| if link.probability > best.probability { link } else { best }))
    }

    /// What every pair across the groups says of its best pose.
    fn said(&self, first: &Part, second: &Part, first_from_second: &Se2) -> Vec<Said> {
        let centre = second.centre(self.prepared);
        let of_pair = |pair: &Matched| {
            let best = pair.proposals.first()?;
            let proposed = first_from_second_by(first, second, pair, &best.pose)?;
            let agrees = !is_apart(&proposed, first_from_second, centre);
            Some(Said { agrees, log_odds: log_odds(best.pose.probability) })
        };
        self.across(first, second).filter_map(of_pair).collect()
    }

    /// Whether some pair of maps across the groups contradicts their link, each the other.
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
                if evidence.is_comparable() && evidence.relaxed.walls.iter().all(contradicts) {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// The pairs of a map of one group and a map of the other.
    fn across(&self, first: &Part, second: &Part) -> impl Iterator<Item = &Matched> {
        let mut places = Vec::new();
        for (a, _) in &first.members {
            for (b, _) in &second.members {
                let maps = (*a.min(b), *a.max(b));
                places.extend(self.pairs.binary_search_by_key(&maps, Matched::maps));
            }
        }
        places.sort_unstable();
        places.into_iter().map(|place| &self.pairs[place])
    }

    /// Distinct poses that pairs across the groups propose, best first: score, pose, probability by
    /// the pair alone.
    fn poses(&self, first: &Part, second: &Part) -> Vec<(f64, Se2, f64)> {
        let mut proposed = Vec::new();
        for pair in self.across(first, second) {
            for proposal in pair.proposals.iter().filter(|found| found.score > LEAST_SCORE) {
                let Some(first_from_second) =
                    first_from_second_by(first, second, pair, &proposal.pose)
                else {
                    break;
                };
                proposed.push((proposal.score, first_from_second, proposal.pose.probability));
            }
        }
        proposed.sort_by(|a, b| b.0.total_cmp(&a.0));
        let centre = second.centre(self.prepared);
        let mut distinct = distinct(proposed, centre);
        distinct.truncate(MOST_POSES);
        distinct
    }
}

/// The pose of the groups that a pose of a pair across them says; `None` of any other pair.
fn first_from_second_by(
    first: &Part,
    second: &Part,
    pair: &Matched,
    pose: &RelativePose,
) -> Option<Se2> {
    let target_from_source = pose.target_from_source;
    let forth = first.pose(pair.target).zip(second.pose(pair.source));
    let back = first.pose(pair.source).zip(second.pose(pair.target));
    match (forth, back) {
        (Some((first_from_target, second_from_source)), _) => {
            Some(first_from_target * target_from_source * second_from_source.inverse())
        }
        (_, Some((first_from_source, second_from_target))) => {
            Some(first_from_source * target_from_source.inverse() * second_from_target.inverse())
        }
        _ => None,
    }
}

/// The first of every answer among poses.
fn distinct(poses: Vec<(f64, Se2, f64)>, centre: Point2<f64>) -> Vec<(f64, Se2, f64)> {
    let mut distinct: Vec<(f64, Se2, f64)> = Vec::new();
    for found in poses {
        if distinct.iter().all(|other| is_apart(&found.1, &other.1, centre)) {
            distinct.push(found);
        }
    }
    distinct
}

/// What a pair of maps says of a link of their groups.
#[derive(Debug, Clone, Copy)]
struct Said {
    /// Whether the best pose of the pair is that of the link.
    agrees: bool,
    /// How likely its best pose is, by the pair alone.
    log_odds: f64,
}

/// Probability of a pose by how many pairs across the groups take it for their best.
///
/// The surest of them counts in full and the others in part: they see the same walls. What two
/// maps of different places say at best is taken off each.
fn agreement(said: &[Said]) -> f64 {
    let more = |said: &Said| (said.log_odds - log_odds(OF_STRANGERS)).max(0.0);
    let agreeing = said.iter().filter(|said| said.agrees);
    let Some(surest) = agreeing.max_by(|a, b| a.log_odds.total_cmp(&b.log_odds)) else {
        return 0.0;
    };
    let all: f64 = said.iter().map(|said| if said.agrees { more(said) } else { -more(said) }).sum();
    let others = all - more(surest);
    probability_from_log_odds(surest.log_odds + SHARED * others).min(MOST_BY_PAIRS)
}

/// Whether a pair is sure of a link by itself and another one takes it for likelier than not.
fn is_witnessed(said: &[Said]) -> bool {
    let agreeing = || said.iter().filter(|said| said.agrees);
    let is_sure = |said: &Said| said.log_odds >= log_odds(SURE);
    agreeing().any(is_sure) && agreeing().filter(|said| said.log_odds >= 0.0).count() > 1
}

/// Whether two poses are two answers.
pub(crate) fn is_apart(a_from_second: &Se2, b_from_second: &Se2, centre: Point2<f64>) -> bool {
    let turn = wrap_angle(a_from_second.theta() - b_from_second.theta()).abs();
    let [a, b] = [a_from_second, b_from_second].map(|pose| *pose * centre);
    turn > APART.1 || (a - b).norm() > APART.0
}

/// The walls of one map, if more of them stand in free space of the other than fit, and by so much
/// that the pose may be wrong. It may be right all the same where the other map was drawn without
/// the furniture: then only one map says so.
pub(crate) fn contradiction(evidence: &Evidence) -> Option<WallFit> {
    evidence.relaxed.walls.into_iter().find(contradicts).filter(|_| evidence.is_comparable())
}

fn contradicts(walls: &WallFit) -> bool {
    walls.conflict_m > VETO_M + walls.hit_m + walls.near_miss_m
}
