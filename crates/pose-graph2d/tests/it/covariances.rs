//! How sure the poses are.

use nalgebra::{Matrix3, Vector3};
use ogm_core::{RelativePose, Se2};
use pose_graph2d::{Edge, PoseGraph, SolveParams, solve};

use crate::world::{Noise, World};

const NOISE: Noise = Noise { metres: 0.03, radians: 0.01 };

#[test]
fn errors_are_as_large_as_the_covariances_say() {
    let (mut sum, mut inside, mut count) = (0.0, 0, 0);
    for seed in 0..100 {
        let world = World::grid(4, NOISE, 1.0, seed);
        let solution = solve(&world.graph, &SolveParams::default(), &()).unwrap();
        for node in &solution.components[0].nodes[1..] {
            let truth = world.truth(0, node.node);
            let found = node.reference_from_node;
            let off = Vector3::new(
                found.x() - truth.x(),
                found.y() - truth.y(),
                truth.between(&found).theta(),
            );
            let distance = off.dot(&(node.covariance.unwrap().try_inverse().unwrap() * off));
            sum += distance;
            inside += usize::from(distance < 7.81);
            count += 1;
        }
    }
    let mean = sum / f64::from(count);
    let share = inside as f64 / f64::from(count);
    assert!((2.7..3.3).contains(&mean) && (0.92..0.98).contains(&share), "{mean} {share}");
}

#[test]
fn a_chain_adds_up_and_a_second_look_halves_the_variance() {
    let pose = RelativePose {
        target_from_source: Se2::new(2.0, 0.0, 0.0),
        covariance: Matrix3::from_diagonal(&Vector3::new(1e-4, 4e-4, 1e-6)),
        probability: 1.0,
    };
    let edge = |target, source| Edge { target, source, hypotheses: vec![pose] };
    let of = |edges: Vec<Edge>| {
        let solution = solve(&PoseGraph { nodes: 3, edges }, &SolveParams::default(), &()).unwrap();
        solution.components[0].nodes[2].covariance.unwrap()
    };
    let chain = of(vec![edge(0, 1), edge(1, 2)]);
    // The turn of the first moves the end of the second, 2 m away.
    let by_hand = [2e-4, 8e-4 + 4.0 * 1e-6, 2e-6];
    for (axis, variance) in by_hand.into_iter().enumerate() {
        assert!((chain[(axis, axis)] - variance).abs() < 1e-9, "{chain}");
    }
    let twice = of(vec![edge(0, 1), edge(0, 1), edge(1, 2), edge(1, 2)]);
    assert!((twice * 2.0 - chain).amax() < 1e-9);
}

#[test]
fn the_reference_is_where_it_was_asked_for_and_certain() {
    let world = World::grid(3, NOISE, 1.0, 1);
    let params = SolveParams { references: vec![5], ..SolveParams::default() };
    let [from_first, from_fifth] =
        [SolveParams::default(), params].map(|params| solve(&world.graph, &params, &()).unwrap());
    let (a, b) = (&from_first.components[0], &from_fifth.components[0]);
    assert_eq!((b.reference, b.nodes[5].reference_from_node), (5, Se2::identity()));
    assert_eq!(b.nodes[5].covariance, Some(Matrix3::zeros()));
    assert!((a.cost - b.cost).abs() < 1e-6 * a.cost);
    let first_from_fifth = a.nodes[5].reference_from_node;
    for (a, b) in a.nodes.iter().zip(&b.nodes) {
        let off = a.reference_from_node.between(&(first_from_fifth * b.reference_from_node));
        assert!(off.translation().norm() < 1e-5 && off.theta().abs() < 1e-6);
    }
}
