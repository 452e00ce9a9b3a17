//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 3314 pairs, 1121 with a right pose listed; loss a pair 0.2865 of the poses, 0.1664 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -11.198,
    terms: [
        1.274, // wall that fits, parts of the maps giving way
        2.369, // wall that fits across the weaker direction of its part, over wall of the better map that does not
        2.640, // wall of the worse map in free space, parts giving way
        0.170, // wall that misses wall narrowly, maps as one piece
        2.451, // area free in both
        2.293, // overlap
        1.793, // how unlikely a hit is by chance
    ],
    any: -1.409,
    score: 0.569,
    lead: 0.825,
    rival: 0.420,
    repeats: 1.289,
    repeats_odds: 0.069,
};
