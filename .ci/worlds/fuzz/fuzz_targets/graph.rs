//! Pose graphs as g2o text, and what is solved of them.

#![no_main]

use libfuzzer_sys::fuzz_target;
use pose_graph2d::{G2oGraph, SolveParams, solve};

/// Beyond this a solution takes its time.
const SMALL: usize = 12;

fuzz_target!(|text: &str| {
    let Ok(read) = G2oGraph::parse(text) else { return };
    let again = G2oGraph::parse(&read.to_text()).expect("what was written can be read");
    assert_eq!(again.ids, read.ids);
    if read.ids.len() <= SMALL && read.graph.edges.len() <= SMALL {
        let _ = solve(&read.graph, &SolveParams::default(), &());
    }
});
