//! Graphs that cannot be meant, and graphs with little in them.

use nalgebra::Matrix3;
use ogm_core::{RelativePose, Se2};
use pose_graph2d::{Edge, GraphError, PoseGraph, SolveParams, solve};

fn pose() -> RelativePose {
    RelativePose {
        target_from_source: Se2::new(1.0, 0.0, 0.0),
        covariance: Matrix3::identity(),
        probability: 1.0,
    }
}

fn solved(nodes: usize, edges: Vec<Edge>) -> Result<pose_graph2d::Solution, GraphError> {
    solve(&PoseGraph { nodes, edges }, &SolveParams::default(), &())
}

fn of(change: impl Fn(&mut Edge)) -> GraphError {
    let mut edge = Edge { target: 0, source: 1, hypotheses: vec![pose()] };
    change(&mut edge);
    solved(2, vec![edge]).unwrap_err()
}

#[test]
fn edges_that_cannot_be_meant_are_errors_that_name_them() {
    assert!(matches!(of(|e| e.source = 2), GraphError::NoSuchNode { edge: 0, node: 2, nodes: 2 }));
    assert!(matches!(of(|e| e.source = 0), GraphError::SameNode { edge: 0, node: 0 }));
    let set = |value: f64| {
        move |edge: &mut Edge| edge.hypotheses[0].target_from_source = Se2::new(value, 0.0, 0.0)
    };
    assert!(matches!(of(set(f64::NAN)), GraphError::Grid(_)));
    for diagonal in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = of(|edge| edge.hypotheses[0].covariance[(1, 1)] = diagonal);
        assert!(matches!(error, GraphError::NotACovariance { edge: 0 }), "{diagonal}: {error}");
    }
    for probability in [-0.1, 1.1, f64::NAN] {
        let error = of(|edge| edge.hypotheses[0].probability = probability);
        assert!(matches!(error, GraphError::NotAProbability { edge: 0, .. }), "{error}");
    }
    let params = SolveParams { gate: f64::NAN, ..SolveParams::default() };
    let empty = PoseGraph::default();
    assert!(matches!(solve(&empty, &params, &()), Err(GraphError::Parameter(_))));
}

#[test]
fn nodes_that_nothing_holds_are_alone() {
    assert!(solved(0, Vec::new()).unwrap().components.is_empty());
    let nothing = Edge { target: 0, source: 2, hypotheses: Vec::new() };
    let solution = solved(3, vec![nothing]).unwrap();
    assert_eq!(solution.components.len(), 3);
    assert!(solution.components.iter().all(|alone| alone.nodes.len() == 1 && alone.is_converged));
    assert_eq!(solution.verdicts, [vec![]]);
}

#[test]
fn given_edges_that_contradict_each_other_are_both_kept_and_cost() {
    let mut other = pose();
    other.target_from_source = Se2::new(21.0, 0.0, 0.0);
    let edge = |pose| Edge { target: 0, source: 1, hypotheses: vec![pose] };
    let solution = solved(2, vec![edge(pose()), edge(other)]).unwrap();
    assert!((solution.components[0].nodes[1].reference_from_node.x() - 11.0).abs() < 1e-9);
    assert!((solution.components[0].cost - 200.0).abs() < 1e-6);
}

#[test]
#[cfg(not(feature = "faer"))]
fn a_graph_too_large_for_the_dense_solver_says_what_to_do() {
    let edge = |target| Edge { target, source: target + 1, hypotheses: vec![pose()] };
    let error = solved(5000, (0..4999).map(edge).collect()).unwrap_err();
    assert!(error.to_string().contains("faer"), "{error}");
}
