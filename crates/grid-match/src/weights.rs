//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 3600 pairs, 1192 with a right pose listed; loss a pair 0.2625 of the poses, 0.1562 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -11.046,
    terms: [
        4.852, // corners of wall that fit, parts giving way
        1.859, // wall of the better map that misses, parts giving way
        1.474, // wall of the worse map in free space, parts giving way
        0.730, // wall that misses wall narrowly, maps as one piece
        0.884, // overlap
        2.641, // how unlikely a hit is by chance
    ],
    any: -1.338,
    score: 0.580,
    lead: 0.753,
    rival: 0.435,
    repeats: 1.513,
    repeats_odds: 0.097,
};
