//! Graphs whose truth is known.

use nalgebra::{Matrix3, Vector3};
use ogm_core::{RelativePose, Se2};
use pose_graph2d::{Edge, PoseGraph};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Standard deviations of a measured pose, metres and radians.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Noise {
    pub(crate) metres: f64,
    pub(crate) radians: f64,
}

impl Noise {
    fn covariance(self) -> Matrix3<f64> {
        let (translation, rotation) = (self.metres.powi(2), self.radians.powi(2));
        Matrix3::from_diagonal(&Vector3::new(translation, translation, rotation))
    }

    fn draw(self, rng: &mut ChaCha8Rng) -> Vector3<f64> {
        let mut normal = || (0..12).map(|_| rng.random_range(-0.5..0.5)).sum::<f64>();
        Vector3::new(self.metres * normal(), self.metres * normal(), self.radians * normal())
    }
}

/// Poses and what was measured between some pairs of them.
pub(crate) struct World {
    pub(crate) world_from_node: Vec<Se2>,
    pub(crate) graph: PoseGraph,
    rng: ChaCha8Rng,
}

impl World {
    /// A walk of unit steps over `side` × `side` crossings, back and forth, with a given edge a step
    /// and one of `probability` to every crossing beside an earlier one.
    pub(crate) fn grid(side: usize, noise: Noise, probability: f64, seed: u64) -> Self {
        let at = |node: usize| {
            let (row, step) = (node / side, node % side);
            let (column, heading) =
                if row % 2 == 0 { (step, 0.0) } else { (side - 1 - step, std::f64::consts::PI) };
            Se2::new(column as f64, row as f64, heading)
        };
        let mut world = Self::of((0..side * side).map(at).collect(), seed);
        for node in 1..side * side {
            world.measure(node - 1, node, noise, 1.0);
        }
        for node in side..side * side {
            let below = (node / side) * 2 * side - 1 - node;
            if below + 1 != node {
                world.measure(below, node, noise, probability);
            }
        }
        world
    }

    /// `laps` rounds of a circle of `around` nodes, each closed on the one before at every third.
    pub(crate) fn circle(around: usize, laps: usize, noise: Noise, seed: u64) -> Self {
        let step = std::f64::consts::TAU / around as f64;
        let radius = 0.5 / (step / 2.0).sin();
        let at = |node: usize| {
            let angle = node as f64 * step;
            Se2::new(radius * angle.cos(), radius * angle.sin(), angle)
        };
        let mut world = Self::of((0..around * laps).map(at).collect(), seed);
        for node in 1..around * laps {
            world.measure(node - 1, node, noise, 1.0);
        }
        for node in (around..around * laps).step_by(3) {
            world.measure(node - around, node, noise, 1.0);
        }
        world
    }

    /// Poses strewn over a square of `side` metres, nothing measured.
    pub(crate) fn strewn(nodes: usize, side: f64, seed: u64) -> Self {
        let mut world = Self::of(Vec::new(), seed);
        let rng = &mut world.rng;
        let mut pose = |_| {
            let [x, y] = [0, 1].map(|_| rng.random_range(0.0..side));
            Se2::new(x, y, rng.random_range(-3.0..3.0))
        };
        world.world_from_node = (0..nodes).map(&mut pose).collect();
        world.graph.nodes = nodes;
        world
    }

    fn of(world_from_node: Vec<Se2>, seed: u64) -> Self {
        let graph = PoseGraph { nodes: world_from_node.len(), edges: Vec::new() };
        Self { world_from_node, graph, rng: ChaCha8Rng::seed_from_u64(seed) }
    }

    pub(crate) fn truth(&self, target: usize, source: usize) -> Se2 {
        self.world_from_node[target].between(&self.world_from_node[source])
    }

    /// A number below `most`.
    pub(crate) fn draw(&mut self, most: usize) -> usize {
        self.rng.random_range(0..most)
    }

    /// What `noise` makes of a pose.
    pub(crate) fn noisy(&mut self, pose: Se2, noise: Noise, probability: f64) -> RelativePose {
        let off = noise.draw(&mut self.rng);
        RelativePose {
            target_from_source: Se2::new(pose.x() + off.x, pose.y() + off.y, pose.theta() + off.z),
            covariance: noise.covariance(),
            probability,
        }
    }

    /// An edge of one hypothesis, the truth with noise.
    pub(crate) fn measure(&mut self, target: usize, source: usize, noise: Noise, probability: f64) {
        let pose = self.noisy(self.truth(target, source), noise, probability);
        self.graph.edges.push(Edge { target, source, hypotheses: vec![pose] });
    }

    /// An edge that says nothing true.
    pub(crate) fn mislead(&mut self, noise: Noise, probability: f64) {
        let nodes = self.graph.nodes;
        let target = self.rng.random_range(0..nodes);
        let source = (target + self.rng.random_range(1..nodes)) % nodes;
        let off = Se2::new(
            self.rng.random_range(2.0..9.0),
            self.rng.random_range(-9.0..9.0),
            self.rng.random_range(-3.0..3.0),
        );
        let pose = self.noisy(self.truth(target, source) * off, noise, probability);
        self.graph.edges.push(Edge { target, source, hypotheses: vec![pose] });
    }
}
