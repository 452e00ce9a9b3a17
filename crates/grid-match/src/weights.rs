//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 3311 pairs, 1138 with a right pose listed; loss a pair 0.2578 of the poses, 0.1467 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -9.142,
    terms: [
        4.988, // parts of the maps that fit, giving way
        2.064, // wall that fits across the weaker direction of its part, over wall of the better map that does not
        1.712, // wall of the worse map in free space, parts giving way
        0.747, // wall that misses wall narrowly, maps as one piece
        0.036, // area free in both
        2.489, // overlap
        2.226, // how unlikely a hit is by chance
    ],
    any: -1.701,
    score: 0.568,
    lead: 0.912,
    rival: 0.357,
    repeats: 1.279,
    repeats_odds: 0.079,
};
