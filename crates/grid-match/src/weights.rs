//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 2621 pairs, 1107 with a right pose listed; loss a pair 0.3491 of the poses, 0.2154 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -18.320,
    terms: [
        // wall that fits over wall that does not, parts of the maps giving way
        2.748, // wall that fits, parts giving way
        1.232, // area free in both
        0.784, // overlap
        2.438, // wall in free space, parts giving way
        1.339, // wall that misses wall narrowly, maps as one piece
        0.492, // wall that fits across the weaker direction
        1.331, // how unlikely a hit is by chance
        3.721,
    ],
    any: -1.435,
    score: 0.449,
    lead: 0.763,
    rival: 0.187,
    repeats: 1.060,
    repeats_odds: 0.072,
};
