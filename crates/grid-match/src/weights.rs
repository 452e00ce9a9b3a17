//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 2636 pairs, 1088 with a right pose listed; loss a pair 0.3230 of the poses, 0.2149 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -20.983,
    terms: [
        // wall that fits over wall that does not, parts of the maps giving way
        2.457, // wall that fits, parts giving way
        1.666, // area free in both
        0.657, // overlap
        1.572, // wall in free space, parts giving way
        1.192, // wall that misses wall narrowly, maps as one piece
        0.419, // wall that fits across the weaker direction
        1.320, // how unlikely a hit is by chance
        3.834,
    ],
    any: -1.723,
    score: 0.438,
    lead: 0.706,
    rival: 0.162,
    repeats: 1.375,
    repeats_odds: 1.000,
};
