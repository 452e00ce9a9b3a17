//! The optimum, certified by its dual.
//!
//! Over unit complex numbers z for rotations and complex t for translations the cost with
//! [`RotationError::Chord`] is a Hermitian form x* M x. Where S = M − diag(λ) with λ = Re(z̄ (M x))
//! over the rotations has no negative eigenvalue, no other poses cost less: Rosen et al., *SE-Sync*
//! (2019), theorem on verification.

use nalgebra::{Complex, DMatrix, DVector};
use ogm_core::Se2;
use pose_graph2d::{PoseGraph, RotationError, SolveParams, solve};

use crate::world::{Noise, World};

/// The form, rows of translations before those of rotations, of a graph without alternatives whose
/// covariances are diagonal and equal in x and y.
fn form(graph: &PoseGraph) -> DMatrix<Complex<f64>> {
    let nodes = graph.nodes;
    let mut form = DMatrix::zeros(2 * nodes, 2 * nodes);
    for edge in &graph.edges {
        let pose = &edge.hypotheses[0];
        let [tau, kappa] = [(0, 0), (2, 2)].map(|at| 1.0 / pose.covariance[at]);
        let motion = pose.target_from_source;
        let turn = Complex::from_polar(1.0, motion.theta());
        let shift = Complex::new(motion.x(), motion.y());
        // Each residual is a row of coefficients.
        let one = Complex::new(1.0, 0.0);
        let (t, z) = (|node: usize| node, |node: usize| nodes + node);
        let rows = [
            (kappa, vec![(z(edge.source), one), (z(edge.target), -turn)]),
            (tau, vec![(t(edge.source), one), (t(edge.target), -one), (z(edge.target), -shift)]),
        ];
        for (weight, row) in rows {
            for &(i, a) in &row {
                for &(j, b) in &row {
                    form[(i, j)] += a.conj() * b * weight;
                }
            }
        }
    }
    form
}

fn coordinates(poses: &[Se2]) -> DVector<Complex<f64>> {
    let at = poses.iter().map(|pose| Complex::new(pose.x(), pose.y()));
    let turns = poses.iter().map(|pose| Complex::from_polar(1.0, pose.theta()));
    DVector::from_iterator(2 * poses.len(), at.chain(turns))
}

/// Cost of the poses, and the smallest eigenvalue of the certificate over the largest of the form.
fn certificate(graph: &PoseGraph, poses: &[Se2]) -> (f64, f64) {
    let nodes = graph.nodes;
    let form = form(graph);
    let x = coordinates(poses);
    let image = &form * &x;
    let cost = x.dotc(&image).re;
    let scale = form.iter().map(|value| value.norm()).fold(0.0, f64::max);
    let mut dual = form;
    for node in 0..nodes {
        dual[(nodes + node, nodes + node)] -= (x[nodes + node].conj() * image[nodes + node]).re;
    }
    let smallest = dual.symmetric_eigenvalues().min();
    (cost, smallest / scale)
}

fn certified(world: &World) {
    let params = SolveParams {
        rotation_error: RotationError::Chord,
        covariances: false,
        ..SolveParams::default()
    };
    let solution = solve(&world.graph, &params, &()).unwrap();
    let [component] = &solution.components[..] else { panic!("one component") };
    let poses: Vec<Se2> = component.nodes.iter().map(|node| node.reference_from_node).collect();
    let (cost, smallest) = certificate(&world.graph, &poses);
    assert!(component.is_converged);
    assert!((component.cost - cost).abs() < 1e-9 * cost, "{} {cost}", component.cost);
    assert!(smallest > -1e-9, "{smallest:e}");
    // A place that is no optimum has no certificate.
    let (worse, negative) = certificate(&world.graph, &world.world_from_node);
    assert!(worse > cost && negative < -1e-7, "{negative:e}");
}

#[test]
fn grids_reach_the_certified_optimum() {
    for seed in 0..4 {
        certified(&World::grid(6, Noise { metres: 0.05, radians: 0.05 }, 1.0, seed));
    }
}

#[test]
fn loops_reach_the_certified_optimum() {
    for seed in 0..4 {
        certified(&World::circle(12, 3, Noise { metres: 0.1, radians: 0.15 }, seed));
    }
}

#[test]
fn the_optimum_of_angles_is_no_further_from_the_truth_than_noise() {
    let noise = Noise { metres: 0.02, radians: 0.01 };
    let world = World::grid(7, noise, 1.0, 3);
    let solution = solve(&world.graph, &SolveParams::default(), &()).unwrap();
    for node in &solution.components[0].nodes {
        let error = node.reference_from_node.between(&world.truth(0, node.node));
        assert!(error.translation().norm() < 0.2, "{error}");
    }
}
