//! Solves a g2o file and prints its cost: `solve FILE.g2o [chord]`.

use pose_graph2d::{G2oGraph, RotationError, SolveParams, solve};

#[expect(clippy::disallowed_methods, reason = "an example of files")]
#[expect(clippy::print_stdout, reason = "an example of results")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let text = match words.next() {
        Some(file) => std::fs::read_to_string(file)?,
        None => "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n".to_owned(),
    };
    let rotation_error = match words.next().as_deref() {
        Some("chord") => RotationError::Chord,
        _ => RotationError::Angle,
    };
    let read = G2oGraph::parse(&text)?;
    let params = SolveParams { rotation_error, covariances: false, ..SolveParams::default() };
    let solution = solve(&read.graph, &params, &())?;
    println!("{} poses, {} edges", read.graph.nodes, read.graph.edges.len());
    for component in &solution.components {
        let (nodes, cost) = (component.nodes.len(), component.cost);
        println!("component of {nodes}: cost {cost:.9}, converged {}", component.is_converged);
    }
    Ok(())
}
