//! Graphs as g2o text: `VERTEX_SE2 id x y θ` and `EDGE_SE2 from to x y θ` with the upper triangle of
//! the information matrix.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use nalgebra::Matrix3;
use ogm_core::{RelativePose, Se2};

use crate::error::GraphError;
use crate::graph::{Edge, PoseGraph, information};

/// A graph from a g2o file, and where the file puts its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct G2oGraph {
    /// Its nodes are numbered in the order of their ids. Every edge has one hypothesis, of
    /// probability 1; lower those of the edges that are doubted.
    pub graph: PoseGraph,
    /// The id of every node.
    pub ids: Vec<u64>,
    /// The pose of every node in the file, for those that have one.
    pub world_from_node: Vec<Option<Se2>>,
}

impl G2oGraph {
    /// Reads the 2D poses and edges of a g2o file; comments, blank lines and `FIX` are passed over.
    ///
    /// The information of an edge is about translation in axes of its measured source, and is
    /// turned into those of the target.
    ///
    /// # Errors
    /// [`GraphError::G2o`] with the number of the line.
    pub fn parse(text: &str) -> Result<Self, GraphError> {
        let mut poses: BTreeMap<u64, Option<Se2>> = BTreeMap::new();
        let mut edges = Vec::new();
        for (line, content) in (1..).zip(text.lines()) {
            let wrong = |what: String| GraphError::G2o { line, what };
            let mut words = content.split_ascii_whitespace();
            let Some(tag) = words.next().filter(|tag| !tag.starts_with('#')) else { continue };
            let (ids, numbers) = match tag {
                "VERTEX_SE2" => (1, 3),
                "EDGE_SE2" => (2, 9),
                "FIX" => continue,
                _ => return Err(wrong(format!("{tag} is not one of VERTEX_SE2, EDGE_SE2, FIX"))),
            };
            let id = |word: &str| {
                word.parse::<u64>().map_err(|_error| wrong(format!("{word:?} is not an id")))
            };
            let number = |word: &str| {
                let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
                number.ok_or_else(|| wrong(format!("{word:?} is not a finite number")))
            };
            let found: Vec<u64> = words.by_ref().take(ids).map(id).collect::<Result<_, _>>()?;
            let values: Vec<f64> = words.map(number).collect::<Result<_, _>>()?;
            if found.len() != ids || values.len() != numbers {
                let has = found.len() + values.len();
                return Err(wrong(format!("{tag} has {has} values, not {}", ids + numbers)));
            }
            let pose = Se2::new(values[0], values[1], values[2]);
            if let [target, source] = found[..] {
                let [xx, xy, xt, yy, yt, tt] =
                    [values[3], values[4], values[5], values[6], values[7], values[8]];
                let in_source = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
                let covariance = information(&in_source)
                    .ok_or_else(|| wrong("the information is not positive definite".to_owned()))?;
                check(&in_source).map_err(wrong)?;
                let covariance = turned(&covariance, pose.theta());
                for id in [target, source] {
                    poses.entry(id).or_insert(None);
                }
                edges.push((
                    target,
                    source,
                    RelativePose { target_from_source: pose, covariance, probability: 1.0 },
                ));
            } else {
                poses.insert(found[0], Some(pose));
            }
        }
        let ids: Vec<u64> = poses.keys().copied().collect();
        let node = |id: u64| ids.partition_point(|&other| other < id);
        let edges = edges.into_iter().map(|(target, source, pose)| Edge {
            target: node(target),
            source: node(source),
            hypotheses: vec![pose],
        });
        let graph = PoseGraph { nodes: ids.len(), edges: edges.collect() };
        graph.check()?;
        Ok(Self { graph, world_from_node: poses.into_values().collect(), ids })
    }

    /// The text of it: every pose that is known, and the likeliest hypothesis of every edge.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        let id = |node: usize| self.ids.get(node).copied().unwrap_or(node as u64);
        for (node, pose) in self.world_from_node.iter().enumerate() {
            if let Some(pose) = pose {
                let (x, y, theta) = (pose.x(), pose.y(), pose.theta());
                // Writing into a string does not fail.
                let _ = writeln!(text, "VERTEX_SE2 {} {x:?} {y:?} {theta:?}", id(node));
            }
        }
        for edge in &self.graph.edges {
            let likeliest = edge.hypotheses.iter().rev();
            let Some(best) = likeliest.max_by(|a, b| a.probability.total_cmp(&b.probability))
            else {
                continue;
            };
            let pose = best.target_from_source;
            let in_source = turned(&best.covariance, -pose.theta());
            let Some(i) = information(&in_source) else { continue };
            let _ = writeln!(
                text,
                "EDGE_SE2 {} {} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
                id(edge.target),
                id(edge.source),
                pose.x(),
                pose.y(),
                pose.theta(),
                i.m11,
                i.m12,
                i.m13,
                i.m22,
                i.m23,
                i.m33,
            );
        }
        text
    }
}

/// Least and most information along any direction, in units of metres and radians, and most of one
/// direction over that of another: of others the inverse is rounding.
const LEAST: f64 = 1e-15;
const MOST: f64 = 1e15;
const MOST_RATIO: f64 = 1e12;

fn check(information: &Matrix3<f64>) -> Result<(), String> {
    let along = information.symmetric_eigenvalues();
    let (least, most) = (along.min(), along.max());
    let is_meant = least >= LEAST && most <= MOST && most <= MOST_RATIO * least;
    is_meant.then_some(()).ok_or_else(|| {
        format!(
            "the information is from {least:e} to {most:e} by direction, not within {LEAST:e} to \
             {MOST:e} with a ratio of at most {MOST_RATIO:e}"
        )
    })
}

/// A covariance of (x, y, θ) in axes turned by `theta`.
fn turned(covariance: &Matrix3<f64>, theta: f64) -> Matrix3<f64> {
    let (sin, cos) = theta.sin_cos();
    let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    turn * covariance * turn.transpose()
}
