//! Weights as the source file that holds them.

use grid_match::{TERM_NAMES, Weights};

use super::options::FitOptions;

/// The text of `crates/grid-match/src/weights.rs`.
pub(super) fn write(weights: &Weights, options: &FitOptions, summary: &str) -> String {
    let Weights { bias, terms, any, score, lead, rival, repeats, repeats_odds } = weights;
    let terms: String = terms
        .iter()
        .zip(TERM_NAMES)
        .map(|(weight, name)| format!("        {weight:.3}, // {name}\n"))
        .collect();
    let FitOptions { seed, count, .. } = options;
    let summary = wrapped(summary);
    format!(
        "//! Weights of the score and of the probability.\n\
         //!\n\
         //! Written by `cargo xtask fit --seed {seed} --count {count}`:\n\
         {summary}\n\
         use crate::terms::Weights;\n\
         \n\
         pub(crate) const WEIGHTS: Weights = Weights {{\n    \
             bias: {bias:.3},\n    \
             terms: [\n{terms}    ],\n    \
             any: {any:.3},\n    \
             score: {score:.3},\n    \
             lead: {lead:.3},\n    \
             rival: {rival:.3},\n    \
             repeats: {repeats:.3},\n    \
             repeats_odds: {repeats_odds:.3},\n\
         }};\n"
    )
}

/// As lines of a module's documentation.
fn wrapped(text: &str) -> String {
    let mut lines = String::new();
    let mut line = String::new();
    for word in text.split(' ') {
        if line.len() + word.len() > 92 {
            lines += &format!("//! {}\n", line.trim_end());
            line.clear();
        }
        line += word;
        line.push(' ');
    }
    lines + &format!("//! {}.\n", line.trim_end())
}
