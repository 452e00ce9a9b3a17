//! The set of hypotheses with the most evidence that agree around every loop.
//!
//! Sets of measurements that agree with each other are the idea of Mangelson, Dominic, Eustice,
//! Vasudevan, *Pairwise Consistent Measurement Set Maximization for Robust Multi-Robot Map Merging*
//! (2018); here there is no odometry to compare along, so each set is grown from a hypothesis and
//! placed as a whole.

use nalgebra::{Matrix3, Vector3};
use ogm_core::{Cancelled, Progress, RelativePose, Se2, Steps, wrap_angle};

use crate::candidate::Members;

/// The surest hypotheses from which a set is grown.
const SEEDS: usize = 64;
/// Passes over all nodes at most.
const MOST_PASSES: usize = 10;

/// A node in the frame of the first, its covariance in the axes of that frame.
#[derive(Debug, Clone, Copy)]
struct Placed {
    first_from_node: Se2,
    covariance: Matrix3<f64>,
}

impl Placed {
    /// Where `pose` puts its source.
    fn then(&self, pose: &RelativePose) -> Self {
        let turn = self.first_from_node.theta();
        let arm = Se2::new(0.0, 0.0, turn) * pose.target_from_source.translation();
        let by_target = Matrix3::new(1.0, 0.0, -arm.y, 0.0, 1.0, arm.x, 0.0, 0.0, 1.0);
        let (sin, cos) = turn.sin_cos();
        let turned = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        Self {
            first_from_node: self.first_from_node * pose.target_from_source,
            covariance: by_target * self.covariance * by_target.transpose()
                + turned * pose.covariance * turned.transpose(),
        }
    }

    /// Squared Mahalanobis distance.
    fn distance_sq(&self, other: &Self) -> f64 {
        let (a, b) = (&self.first_from_node, &other.first_from_node);
        let off = Vector3::new(a.x() - b.x(), a.y() - b.y(), wrap_angle(a.theta() - b.theta()));
        let inverse = (self.covariance + other.covariance).try_inverse();
        inverse.map_or(f64::INFINITY, |inverse| off.dot(&(inverse * off)))
    }
}

/// One way to place a node by one that is placed already.
#[derive(Debug, Clone, Copy)]
struct Proposal {
    candidate: usize,
    placed: Placed,
}

/// Which of the members agree and cost the most to call wrong, one an edge at most.
pub(crate) fn consistent(
    members: &Members<'_>,
    gate: f64,
    progress: &dyn Progress,
) -> Result<Vec<usize>, Cancelled> {
    let Members { candidates, indices, nodes, local } = *members;
    let mut at_node = vec![Vec::new(); nodes];
    for &index in indices {
        at_node[local(candidates[index].target)].push(index);
        at_node[local(candidates[index].source)].push(index);
    }
    let sets = Sets { members, at_node, gate };
    let mut seeds = indices.to_vec();
    seeds.sort_by(|&a, &b| candidates[b].evidence().total_cmp(&candidates[a].evidence()));
    seeds.truncate(SEEDS);
    let done = Steps::new(progress, seeds.len());
    let mut best = (f64::NEG_INFINITY, Vec::new());
    for seed in seeds {
        let (evidence, set) = sets.grown_from(seed);
        // What differs by rounding alone is left to the surer seed.
        if evidence > best.0 + 1e-9 {
            best = (evidence, set);
        }
        done.step()?;
    }
    Ok(best.1)
}

struct Sets<'a> {
    members: &'a Members<'a>,
    at_node: Vec<Vec<usize>>,
    gate: f64,
}

impl Sets<'_> {
    fn local(&self, node: usize) -> usize {
        (self.members.local)(node)
    }

    fn grown_from(&self, seed: usize) -> (f64, Vec<usize>) {
        let nodes = self.at_node.len();
        let mut placed: Vec<Option<Placed>> = vec![None; nodes];
        let mut proposals: Vec<Vec<Proposal>> = vec![Vec::new(); nodes];
        let mut best: Vec<Option<(f64, Placed)>> = vec![None; nodes];
        let first = Placed { first_from_node: Se2::identity(), covariance: Matrix3::zeros() };
        let mut next = Some((self.local(self.members.candidates[seed].target), first));
        // The seed comes first whatever else there is.
        let forced = self.local(self.members.candidates[seed].source);
        while let Some((node, at)) = next {
            placed[node] = Some(at);
            for &index in &self.at_node[node] {
                let (other, pose) = self.seen_from(index, node);
                if placed[other].is_none() {
                    proposals[other].push(Proposal { candidate: index, placed: at.then(&pose) });
                    best[other] = self.best_place(&proposals[other]);
                }
            }
            if placed[forced].is_none() {
                let by_seed = proposals[forced].iter().find(|p| p.candidate == seed);
                next = by_seed.map(|proposal| (forced, proposal.placed));
                continue;
            }
            let free = (0..nodes).filter(|&node| placed[node].is_none());
            let reachable = free.filter_map(|node| Some((node, best[node]?)));
            next = reachable
                .max_by(|a, b| a.1.0.total_cmp(&b.1.0).then(b.0.cmp(&a.0)))
                .map(|(node, (_, at))| (node, at));
        }
        self.replace(&mut placed);
        self.agreeing(&placed)
    }

    /// Lays every node where the others want it, until all are where they want each other.
    fn replace(&self, placed: &mut [Option<Placed>]) {
        for _ in 0..MOST_PASSES {
            let mut has_moved = false;
            for node in 0..placed.len() {
                let Some(at) = placed[node] else { continue };
                let proposals: Vec<Proposal> = self.at_node[node]
                    .iter()
                    .filter_map(|&index| {
                        let (other, pose) = self.seen_from(index, node);
                        let placed = placed[other]?.then(&pose.inverse());
                        Some(Proposal { candidate: index, placed })
                    })
                    .collect();
                let Some((evidence, better)) = self.best_place(&proposals) else { continue };
                let (now, _) = self.support(&at, &proposals);
                if evidence > 1.001 * now && better.distance_sq(&at) > self.gate {
                    placed[node] = Some(better);
                    has_moved = true;
                }
            }
            if !has_moved {
                break;
            }
        }
    }

    /// The other end of a candidate, and where it lies in `node`.
    fn seen_from(&self, index: usize, node: usize) -> (usize, RelativePose) {
        let candidate = &self.members.candidates[index];
        let [target, source] = [candidate.target, candidate.source].map(|end| self.local(end));
        if target == node { (source, candidate.pose) } else { (target, candidate.pose.inverse()) }
    }

    /// The place of a node on which the most evidence agrees.
    fn best_place(&self, proposals: &[Proposal]) -> Option<(f64, Placed)> {
        let supported = proposals.iter().map(|proposal| {
            let (evidence, _) = self.support(&proposal.placed, proposals);
            (evidence, proposal.placed)
        });
        supported.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn support(&self, at: &Placed, proposals: &[Proposal]) -> (f64, Vec<usize>) {
        self.of_edges(proposals.iter().map(|other| {
            let share = 1.0 - at.distance_sq(&other.placed) / self.gate;
            (self.members.candidates[other.candidate].edge, other.candidate, share)
        }))
    }

    fn agreeing(&self, placed: &[Option<Placed>]) -> (f64, Vec<usize>) {
        let agreeing = self.members.indices.iter().filter_map(|&index| {
            let candidate = &self.members.candidates[index];
            let target = placed[self.local(candidate.target)]?;
            let source = placed[self.local(candidate.source)]?;
            let share = 1.0 - target.then(&candidate.pose).distance_sq(&source) / self.gate;
            Some((candidate.edge, index, share))
        });
        self.of_edges(agreeing)
    }

    /// Evidence of the candidates with a share above 0, the best of every edge, and which these are.
    fn of_edges(&self, shares: impl Iterator<Item = (usize, usize, f64)>) -> (f64, Vec<usize>) {
        let mut agreeing: Vec<(usize, f64, usize)> = shares
            .filter(|&(_, _, share)| share > 0.0)
            .map(|(edge, index, share)| {
                (edge, self.members.candidates[index].evidence() * share, index)
            })
            .collect();
        agreeing.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        agreeing.dedup_by_key(|(edge, _, _)| *edge);
        let total = agreeing.iter().map(|(_, evidence, _)| evidence).sum();
        (total, agreeing.into_iter().map(|(_, _, index)| index).collect())
    }
}
