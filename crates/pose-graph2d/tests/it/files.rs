//! g2o in and out.

use ogm_core::Se2;
use pose_graph2d::{G2oGraph, GraphError, SolveParams, solve};

const TEXT: &str = "\
# two poses and what lies between them
VERTEX_SE2 10 0 0 0
VERTEX_SE2 7 1 0 1.5

EDGE_SE2 10 7 1.0 0.1 1.57 400 0 0 100 0 2500
FIX 10
";

#[test]
fn poses_and_edges_come_back_as_they_were_written() {
    let read = G2oGraph::parse(TEXT).unwrap();
    assert_eq!(read.ids, [7, 10]);
    assert_eq!(read.world_from_node[0], Some(Se2::new(1.0, 0.0, 1.5)));
    let again = G2oGraph::parse(&read.to_text()).unwrap();
    assert_eq!(again.ids, read.ids);
    let [a, b] = [&read, &again].map(|file| &file.graph.edges[0]);
    assert_eq!((a.target, a.source), (b.target, b.source));
    assert!((a.hypotheses[0].covariance - b.hypotheses[0].covariance).amax() < 1e-12);
}

#[test]
fn the_information_is_in_the_axes_of_the_measured_pose() {
    let read = G2oGraph::parse(TEXT).unwrap();
    // x of the measured pose is nearly y of the target.
    let covariance = read.graph.edges[0].hypotheses[0].covariance;
    assert!((covariance[(0, 0)] - 0.01).abs() < 1e-4, "{covariance}");
    assert!((covariance[(1, 1)] - 0.0025).abs() < 1e-4, "{covariance}");
    // So the cost is that of g2o: (0.3, 0, 0) off along the measured x costs 0.09 · 400.
    let turn = Se2::new(0.0, 0.0, 1.57);
    let mut graph = read.graph.clone();
    let mut second = graph.edges[0].clone();
    let there = second.hypotheses[0].target_from_source * Se2::new(0.3, 0.0, 0.0);
    second.hypotheses[0].target_from_source = there;
    graph.edges.push(second);
    let solution = solve(&graph, &SolveParams::default(), &()).unwrap();
    // Both give way by half.
    assert!((solution.components[0].cost - 2.0 * 0.15_f64.powi(2) * 400.0).abs() < 1e-6);
    assert!((turn.theta() - 1.57).abs() < 1e-12);
}

#[test]
fn a_bad_line_is_named() {
    for (text, line, word) in [
        ("VERTEX_SE2 0 0 0\n", 1, "3 values"),
        ("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 0 0 0 1 0 0 1 0\n", 2, "values"),
        ("\nVERTEX_SE2 0 0 zero 0\n", 2, "zero"),
        ("VERTEX_SE2 0 nan 0 0\n", 1, "nan"),
        ("VERTEX_SE2 -1 0 0 0\n", 1, "-1"),
        ("EDGE_SE2 0 1 0 0 0 0 0 0 1 0 1\n", 1, "positive definite"),
        ("EDGE_SE2 0 1 0 0 0 1e20 0 0 1e20 0 1e20\n", 1, "within"),
        ("EDGE_SE2 0 1 0 0 0 1e13 0 0 1 0 1\n", 1, "ratio"),
        ("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n", 1, "VERTEX_SE3"),
    ] {
        let error = G2oGraph::parse(text).unwrap_err();
        let GraphError::G2o { line: found, what } = &error else { panic!("{error}") };
        assert!(*found == line && what.contains(word), "{error}");
    }
}
