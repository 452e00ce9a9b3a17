//! Large graphs of every shape, by seed.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};
use ogm_core::{RelativePose, Se2};
use pose_graph2d::{Edge, G2oGraph, PoseGraph};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a graph looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Lanes back and forth, an edge from every place to the one beside it on the lane before.
    Grid,
    /// A walk along streets that cross every metre; edges between times at crossings side by side.
    Streets,
    /// Rounds of a circle, each closed on the one before.
    Laps,
    /// A walk that rarely meets itself, of a robot that hardly knows how far it turned.
    Chain,
}

/// A graph to draw.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Draw {
    pub(crate) shape: Shape,
    pub(crate) nodes: usize,
    /// Most edges; fewer where there are no more.
    pub(crate) edges: usize,
    /// Standard deviation of a measured translation, metres on each axis.
    pub(crate) metres: f64,
    /// Standard deviation of a measured rotation, radians.
    pub(crate) radians: f64,
}

impl Draw {
    pub(crate) fn name(&self, seed: u64) -> String {
        let shape = format!("{:?}", self.shape).to_lowercase();
        format!("{shape}-{}-{}-{seed}", self.nodes, self.radians)
    }

    /// The graph, its poses where odometry alone puts them, and the true ones.
    pub(crate) fn graph(&self, seed: u64) -> (G2oGraph, Vec<Se2>) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let world_from_node = match self.shape {
            Shape::Grid => lanes(self.nodes),
            Shape::Streets => walk(self.nodes, 0.6, &mut rng),
            Shape::Laps => laps(self.nodes),
            Shape::Chain => walk(self.nodes, 3.0, &mut rng),
        };
        let mut pairs: Vec<(usize, usize)> = (1..self.nodes).map(|node| (node - 1, node)).collect();
        let mut closures = closures(self.shape, &world_from_node);
        for index in 0..(self.edges - pairs.len()).min(closures.len()) {
            let other = rng.random_range(index..closures.len());
            closures.swap(index, other);
            pairs.push(closures[index]);
        }
        let edge = |&(target, source): &(usize, usize)| {
            let target_from_source = world_from_node[target].between(&world_from_node[source]);
            let pose = self.measured(&target_from_source, &mut rng);
            Edge { target, source, hypotheses: vec![pose] }
        };
        let edges: Vec<Edge> = pairs.iter().map(edge).collect();
        let odometry = edges[..self.nodes - 1].iter().scan(Se2::identity(), |at, edge| {
            *at = *at * edge.hypotheses[0].target_from_source;
            Some(*at)
        });
        let by_odometry = std::iter::once(Se2::identity()).chain(odometry).map(Some).collect();
        let file = G2oGraph {
            graph: PoseGraph { nodes: self.nodes, edges },
            ids: (0..self.nodes as u64).collect(),
            world_from_node: by_odometry,
        };
        (file, world_from_node)
    }

    fn measured(&self, target_from_source: &Se2, rng: &mut ChaCha8Rng) -> RelativePose {
        let [x, y, theta] = [self.metres, self.metres, self.radians].map(|sigma| {
            // Twelve uniform numbers are as good as normal.
            sigma * (0..12).map(|_| rng.random_range(-0.5..0.5)).sum::<f64>()
        });
        let at = target_from_source.translation();
        let (translation, rotation) = (self.metres.powi(2), self.radians.powi(2));
        RelativePose {
            target_from_source: Se2::new(at.x + x, at.y + y, target_from_source.theta() + theta),
            covariance: Matrix3::from_diagonal(&Vector3::new(translation, translation, rotation)),
            probability: 1.0,
        }
    }
}

fn side(nodes: usize) -> usize {
    (1..).find(|side| side * side >= nodes).unwrap_or(1)
}

fn lanes(nodes: usize) -> Vec<Se2> {
    let side = side(nodes);
    let at = |node: usize| {
        let (lane, step) = (node / side, node % side);
        let (along, heading) =
            if lane % 2 == 0 { (step, 0.0) } else { (side - 1 - step, TAU / 2.0) };
        Se2::new(along as f64, lane as f64, heading)
    };
    (0..nodes).map(at).collect()
}

/// A walk by steps of a metre with turns at random, in a square of `roominess` times as many
/// crossings a side as would do for one visit each.
fn walk(nodes: usize, roominess: f64, rng: &mut ChaCha8Rng) -> Vec<Se2> {
    let half = (roominess * side(nodes) as f64 / 2.0).floor();
    let (mut x, mut y, mut quarter) = (0.0_f64, 0.0_f64, 0_u8);
    let mut poses = vec![Se2::identity()];
    while poses.len() < nodes {
        if rng.random_bool(0.15) {
            quarter = (quarter + if rng.random_bool(0.5) { 1 } else { 3 }) % 4;
        }
        let step = |quarter: u8| {
            let (sin, cos) = (f64::from(quarter) * FRAC_PI_2).sin_cos();
            ((x + cos).round(), (y + sin).round())
        };
        while step(quarter).0.abs().max(step(quarter).1.abs()) > half {
            quarter = (quarter + 1) % 4;
        }
        (x, y) = step(quarter);
        poses.push(Se2::new(x, y, f64::from(quarter) * FRAC_PI_2));
    }
    poses
}

/// Rounds of 200 poses.
const AROUND: usize = 200;

fn laps(nodes: usize) -> Vec<Se2> {
    let step = TAU / AROUND as f64;
    let radius = 0.5 / (step / 2.0).sin();
    let at = |node: usize| {
        let (sin, cos) = (node as f64 * step).sin_cos();
        Se2::new(radius * cos, radius * sin, node as f64 * step + FRAC_PI_2)
    };
    (0..nodes).map(at).collect()
}

/// Pairs that may have an edge besides that of the step from one to the next.
fn closures(shape: Shape, world_from_node: &[Se2]) -> Vec<(usize, usize)> {
    let nodes = world_from_node.len();
    match shape {
        Shape::Grid => {
            let side = side(nodes);
            let below = |node: usize| (node / side) * 2 * side - 1 - node;
            let pairs = (side..nodes).map(|node| (below(node), node));
            pairs.filter(|(below, node)| below + 1 < *node).collect()
        }
        Shape::Laps => (AROUND..nodes).map(|node| (node - AROUND, node)).collect(),
        Shape::Streets | Shape::Chain => side_by_side(world_from_node),
    }
}

/// Pairs no further apart than a crossing along both streets, and not within three steps.
fn side_by_side(world_from_node: &[Se2]) -> Vec<(usize, usize)> {
    #[expect(clippy::cast_possible_truncation, reason = "crossings of some hundred streets")]
    let crossing = |world_from_node: &Se2| {
        (world_from_node.x().round() as i64, world_from_node.y().round() as i64)
    };
    let mut at = std::collections::BTreeMap::<(i64, i64), Vec<usize>>::new();
    for (node, pose) in world_from_node.iter().enumerate() {
        at.entry(crossing(pose)).or_default().push(node);
    }
    let mut pairs = Vec::new();
    for (node, pose) in world_from_node.iter().enumerate() {
        let (x, y) = crossing(pose);
        for beside in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy))) {
            let others = at.get(&beside).into_iter().flatten();
            pairs.extend(others.filter(|&&other| other > node + 3).map(|&other| (node, other)));
        }
    }
    pairs
}
