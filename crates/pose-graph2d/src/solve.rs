//! The front door: a graph in, poses and verdicts out.

use ogm_core::{Progress, Stage};

use crate::candidate::{Candidate, Members};
use crate::components::{bridges, groups};
use crate::consistent::consistent;
use crate::constraint::Constraint;
use crate::error::GraphError;
use crate::graduated::graduated;
use crate::graph::PoseGraph;
use crate::optimise::{Optimum, Problem};
use crate::params::{Selection, SolveParams};
use crate::solution::{Component, PlacedNode, Solution, Verdict};
use crate::start::start;

/// Rounds in which hypotheses leave or come back as the poses move.
const MOST_ROUNDS: usize = 6;
/// Share of the work that selection takes.
const SELECTED: f64 = 0.5;

/// Finds the poses of all nodes, and which hypotheses are wrong.
///
/// No start is needed. Hypotheses that are not given are selected first (see [`Selection`]); the
/// poses are then those of least squares over what was selected. What then lies beyond the gate is
/// rejected, what agrees is taken back, and a hypothesis that alone would hold two parts together
/// must be as sure as [`SolveParams::accept`] asks.
///
/// # Errors
/// A graph or parameters that cannot be meant, more nodes than can be solved without the feature
/// `faer`, or a cancelled call.
pub fn solve(
    graph: &PoseGraph,
    params: &SolveParams,
    progress: &dyn Progress,
) -> Result<Solution, GraphError> {
    params.check()?;
    graph.check()?;
    let candidates = Candidate::all(graph)?;
    let solver = Solver { nodes: graph.nodes, candidates: &candidates, params };
    let mut used = solver.selected(&Stage::new(progress, 0.0, SELECTED))?;
    let rest = Stage::new(progress, SELECTED, 1.0);
    let mut round = 0;
    let (groups, distances) = loop {
        solver.drop_unconfirmed(&mut used);
        let groups = solver.placed(&used, &Stage::nth(&rest, round, MOST_ROUNDS))?;
        let distances = solver.distances(&groups);
        let mut agreeing = solver.agreeing(&distances);
        solver.drop_unconfirmed(&mut agreeing);
        round += 1;
        if agreeing == used || round == MOST_ROUNDS {
            break (groups, distances);
        }
        used = agreeing;
    };
    let components = groups.iter().map(|group| group.component(params));
    let components = components.collect::<Result<_, GraphError>>()?;
    progress.report(1.0);
    Ok(Solution { components, verdicts: solver.verdicts(&used, &distances, graph) })
}

/// Nodes that hang together, the reference first; its terms number them by their places.
struct Group {
    nodes: Vec<usize>,
    constraints: Vec<Constraint>,
    optimum: Optimum,
}

impl Group {
    fn component(&self, params: &SolveParams) -> Result<Component, GraphError> {
        let Self { nodes, constraints, optimum } = self;
        let problem = Problem { constraints, rotation_error: params.rotation_error };
        let covariances = if params.covariances {
            problem.covariances(&optimum.poses)?.into_iter().map(Some).collect()
        } else {
            vec![None; nodes.len()]
        };
        let placed = nodes.iter().zip(&optimum.poses).zip(covariances);
        let mut placed: Vec<PlacedNode> = placed
            .map(|((&node, &pose), covariance)| PlacedNode {
                node,
                reference_from_node: pose.into(),
                covariance,
            })
            .collect();
        placed.sort_by_key(|placed| placed.node);
        Ok(Component {
            reference: nodes[0],
            nodes: placed,
            cost: optimum.cost,
            is_converged: optimum.is_converged,
        })
    }
}

/// The group of every node, and its place there.
fn places<'a>(nodes: usize, groups: impl Iterator<Item = &'a [usize]>) -> Vec<[usize; 2]> {
    let mut places = vec![[0, 0]; nodes];
    for (index, group) in groups.enumerate() {
        for (place, &node) in group.iter().enumerate() {
            places[node] = [index, place];
        }
    }
    places
}

struct Solver<'a> {
    nodes: usize,
    candidates: &'a [Candidate],
    params: &'a SolveParams,
}

impl Solver<'_> {
    fn selected(&self, progress: &dyn Progress) -> Result<Vec<bool>, GraphError> {
        if self.candidates.iter().all(Candidate::is_given) {
            return Ok(vec![true; self.candidates.len()]);
        }
        let groups = groups(self.nodes, self.candidates.iter().map(|c| (c.target, c.source)));
        let places = places(self.nodes, groups.iter().map(Vec::as_slice));
        let mut members = vec![Vec::new(); groups.len()];
        for (index, candidate) in self.candidates.iter().enumerate() {
            let [group, _] = places[candidate.target];
            members[group].push(index);
        }
        let mut used: Vec<bool> = self.candidates.iter().map(Candidate::is_given).collect();
        for (index, (group, members)) in groups.iter().zip(&members).enumerate() {
            let stage = Stage::nth(progress, index, groups.len());
            let local = |node: usize| places[node][1];
            let members = Members {
                candidates: self.candidates,
                indices: members,
                nodes: group.len(),
                local: &local,
            };
            let found = match self.params.selection {
                Selection::Consistent => consistent(&members, self.params.gate, &stage)?,
                Selection::Graduated => graduated(&members, self.params, &stage)?,
            };
            for index in found {
                used[index] = true;
            }
        }
        Ok(used)
    }

    fn used<'b>(&'b self, used: &'b [bool]) -> impl Iterator<Item = &'b Candidate> {
        self.candidates.iter().zip(used).filter(|(_, used)| **used).map(|(candidate, _)| candidate)
    }

    fn ends(&self, used: &[bool]) -> Vec<(usize, usize)> {
        self.used(used).map(|candidate| (candidate.target, candidate.source)).collect()
    }

    fn drop_unconfirmed(&self, used: &mut [bool]) {
        let is_bridge = bridges(self.nodes, &self.ends(used));
        let mut is_bridge = is_bridge.into_iter();
        for (used, candidate) in used.iter_mut().zip(self.candidates) {
            if *used {
                let is_loose = is_bridge.next() == Some(true);
                *used = !is_loose || candidate.pose.probability >= self.params.accept;
            }
        }
    }

    fn placed(&self, used: &[bool], progress: &dyn Progress) -> Result<Vec<Group>, GraphError> {
        let mut groups = groups(self.nodes, self.ends(used).into_iter());
        for group in &mut groups {
            let mut references = self.params.references.iter();
            let place = references.find_map(|node| group.binary_search(node).ok());
            group[..=place.unwrap_or(0)].rotate_right(1);
        }
        let places = places(self.nodes, groups.iter().map(Vec::as_slice));
        let mut constraints = vec![Vec::new(); groups.len()];
        for candidate in self.used(used) {
            let [group, _] = places[candidate.target];
            constraints[group].push(candidate.constraint(|node| places[node][1]));
        }
        let count = groups.len();
        let together = groups.into_iter().zip(constraints).enumerate();
        let solved = together.map(|(index, (nodes, constraints))| {
            let problem =
                Problem { constraints: &constraints, rotation_error: self.params.rotation_error };
            let stage = Stage::nth(progress, index, count);
            let poses = start(nodes.len(), &constraints)?;
            let optimum = problem.minimise(poses, self.params.max_iterations, &stage)?;
            Ok(Group { nodes, constraints, optimum })
        });
        solved.collect()
    }

    /// Squared Mahalanobis distance of every hypothesis between nodes of one group, infinite
    /// between groups.
    fn distances(&self, groups: &[Group]) -> Vec<f64> {
        let places = places(self.nodes, groups.iter().map(|group| &group.nodes[..]));
        let distance = |candidate: &Candidate| {
            let [group, other] = [candidate.target, candidate.source].map(|node| places[node][0]);
            if group != other {
                return f64::INFINITY;
            }
            let constraint = candidate.constraint(|node| places[node][1]);
            constraint.distance_sq(&groups[group].optimum.poses, self.params.rotation_error)
        };
        self.candidates.iter().map(distance).collect()
    }

    /// The hypothesis of every edge that agrees best with the poses, if it is within the gate.
    fn agreeing(&self, distances: &[f64]) -> Vec<bool> {
        let mut agreeing: Vec<bool> = self.candidates.iter().map(Candidate::is_given).collect();
        let edge_of = |&index: &usize| self.candidates[index].edge;
        let indices: Vec<usize> = (0..self.candidates.len()).collect();
        for edge in indices.chunk_by(|a, b| edge_of(a) == edge_of(b)) {
            let best = edge.iter().min_by(|&&a, &&b| distances[a].total_cmp(&distances[b]));
            if let Some(&best) = best.filter(|&&best| distances[best] <= self.params.gate) {
                agreeing[best] = true;
            }
        }
        agreeing
    }

    fn verdicts(&self, used: &[bool], distances: &[f64], graph: &PoseGraph) -> Vec<Vec<Verdict>> {
        let mut verdicts: Vec<Vec<Verdict>> = vec![Vec::new(); graph.edges.len()];
        let mut has_used = vec![false; graph.edges.len()];
        for candidate in self.used(used) {
            has_used[candidate.edge] = true;
        }
        for ((candidate, &used), &distance_sq) in self.candidates.iter().zip(used).zip(distances) {
            let verdict = if used {
                Verdict::Used { distance_sq }
            } else if has_used[candidate.edge] {
                Verdict::Outranked
            } else if distance_sq > self.params.gate && distance_sq.is_finite() {
                Verdict::Contradicted { distance_sq }
            } else {
                Verdict::Unconfirmed { probability: candidate.pose.probability }
            };
            verdicts[candidate.edge].push(verdict);
        }
        verdicts
    }
}
