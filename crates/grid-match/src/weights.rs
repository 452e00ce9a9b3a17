//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 3313 pairs, 1111 with a right pose listed; loss a pair 0.2877 of the poses, 0.1636 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -10.572,
    terms: [
        // wall that fits, parts of the maps giving way
        1.057,
        // wall that fits across the weaker direction of its part, over wall of the better map that does not
        2.398, // wall of the worse map in free space, parts giving way
        2.639, // wall that misses wall narrowly, maps as one piece
        0.120, // area free in both
        2.552, // overlap
        2.424, // how unlikely a hit is by chance
        1.682,
    ],
    any: -1.449,
    score: 0.573,
    lead: 0.854,
    rival: 0.434,
    repeats: 1.234,
    repeats_odds: 0.061,
};
