//! Large graphs by seed: whether they are solved to the optimum, and what that costs.
//!
//! - `optima`: draws graphs, solves them from what was measured alone and prints a table with the
//!   most by which each may miss the optimum; fails where that is more than 10⁻⁶ of the cost.
//! - `optima write FOLDER`: writes the first of every kind as a g2o file, started by odometry.
//! - `optima time FILE…`: prints `FILE COST SECONDS` for each, by angles as in g2o.

mod certificate;
mod clock;
mod graphs;

use std::process::ExitCode;

use graphs::{Draw, Shape};
use ogm_core::Se2;
use pose_graph2d::{G2oGraph, PoseGraph, RotationError, Solution, SolveParams, solve};

use crate::certificate::{Certificate, certificate};
use crate::clock::least_seconds;

type Failure = Box<dyn std::error::Error>;

/// A cost may exceed the optimum by this share.
const MOST_GAP: f64 = 1e-6;
const SEEDS: std::ops::Range<u64> = 1..4;
const ROUNDS: usize = 3;

const DRAWS: [Draw; 10] = [
    draw(Shape::Grid, [1000, 2000], 0.05, 0.02),
    draw(Shape::Grid, [10_000, 20_000], 0.05, 0.02),
    draw(Shape::Grid, [10_000, 20_000], 0.1, 0.1),
    draw(Shape::Streets, [3500, 5450], 0.03, 0.02),
    draw(Shape::Streets, [10_000, 20_000], 0.03, 0.02),
    draw(Shape::Streets, [10_000, 20_000], 0.1, 0.1),
    draw(Shape::Laps, [2000, 2180], 0.05, 0.02),
    draw(Shape::Laps, [10_000, 20_000], 0.05, 0.05),
    draw(Shape::Chain, [3500, 3700], 0.05, 0.03),
    draw(Shape::Chain, [10_000, 10_500], 0.05, 0.03),
];
/// So much noise in rotation, or so few closures, that the start may be in another valley, or the
/// dual says nothing. Nothing is promised of them.
const BEYOND: [Draw; 3] = [
    draw(Shape::Grid, [10_000, 20_000], 0.1, 0.3),
    draw(Shape::Laps, [10_000, 10_500], 0.05, 0.1),
    draw(Shape::Chain, [10_000, 10_200], 0.05, 0.1),
];

const fn draw(shape: Shape, [nodes, edges]: [usize; 2], metres: f64, radians: f64) -> Draw {
    Draw { shape, nodes, edges, metres, radians }
}

fn main() -> Result<ExitCode, Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => table(),
        ["write", folder] => write(folder),
        ["time", ref files @ ..] => time(files),
        _ => Err("optima [write FOLDER | time FILE…]".into()),
    }
}

fn solved(graph: &PoseGraph, rotation_error: RotationError) -> Result<(f64, Solution), Failure> {
    let params = SolveParams { rotation_error, covariances: false, ..SolveParams::default() };
    let (seconds, solution) = least_seconds(ROUNDS, || solve(graph, &params, &()));
    Ok((seconds, solution?))
}

fn table() -> Result<ExitCode, Failure> {
    print(
        "| graph | poses | edges | noise, m | rad | cost | odometry alone, times that \
         | above the optimum, at most | CPU, s |\n\
         | --- | --: | --: | --: | --: | --: | --: | --: | --: |\n",
    )?;
    let mut all_hold = true;
    for draw in DRAWS {
        for seed in SEEDS {
            all_hold &= row(&draw, seed)?;
        }
    }
    for draw in BEYOND {
        for seed in SEEDS {
            row(&draw, seed)?;
        }
    }
    Ok(if all_hold { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Prints what came of a graph, and says whether that is the optimum.
fn row(draw: &Draw, seed: u64) -> Result<bool, Failure> {
    let (file, truth) = draw.graph(seed);
    let graph = &file.graph;
    let (seconds, solution) = solved(graph, RotationError::Chord)?;
    let nodes = &solution.components[0].nodes;
    let poses: Vec<Se2> = nodes.iter().map(|node| node.reference_from_node).collect();
    let found = certificate(graph, &poses);
    if is_best(&certificate(graph, &truth)) {
        return Err("the true poses, which fit worse, have a certificate: it says nothing".into());
    }
    let odometry: Vec<Se2> = file.world_from_node.iter().flatten().copied().collect();
    let start = certificate(graph, &odometry).cost / found.cost;
    let gap =
        found.gap.map_or("no certificate".to_owned(), |gap| format!("{:.0e}", gap / found.cost));
    let (edges, metres, radians) = (graph.edges.len(), draw.metres, draw.radians);
    print(&format!(
        "| {:?}, seed {seed} | {} | {edges} | {metres} | {radians} | {:.4} | {start:.0} | {gap} \
         | {seconds:.2} |\n",
        draw.shape, draw.nodes, found.cost
    ))?;
    Ok(is_best(&found))
}

fn is_best(found: &Certificate) -> bool {
    found.gap.is_some_and(|gap| gap <= MOST_GAP * found.cost)
}

#[expect(clippy::disallowed_methods, reason = "an example of files")]
fn write(folder: &str) -> Result<ExitCode, Failure> {
    for draw in DRAWS {
        let text = draw.graph(SEEDS.start).0.to_text();
        std::fs::write(format!("{folder}/{}.g2o", draw.name(SEEDS.start)), text)?;
    }
    Ok(ExitCode::SUCCESS)
}

#[expect(clippy::disallowed_methods, reason = "an example of files")]
fn time(files: &[&str]) -> Result<ExitCode, Failure> {
    for file in files {
        let graph = G2oGraph::parse(&std::fs::read_to_string(file)?)?.graph;
        let (seconds, solution) = solved(&graph, RotationError::Angle)?;
        let cost: f64 = solution.components.iter().map(|component| component.cost).sum();
        print(&format!("{file} {cost:?} {seconds:?}\n"))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write;
    Ok(std::io::stdout().write_all(text.as_bytes())?)
}
