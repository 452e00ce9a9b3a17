//! Weights of the score and of the probability.
//!
//! Written by `cargo xtask fit --seed 400000 --count 100`:
//! 3312 pairs, 1118 with a right pose listed; loss a pair 0.2947 of the poses, 0.1718 of any of
//! them.

use crate::terms::Weights;

pub(crate) const WEIGHTS: Weights = Weights {
    bias: -10.847,
    terms: [
        // wall that fits, parts of the maps giving way
        1.137,
        // wall that fits across the weaker direction of its part, over wall of the better map that does not
        2.338, // wall of the worse map in free space, parts giving way
        2.616, // wall that misses wall narrowly, maps as one piece
        0.157, // area free in both
        2.526, // overlap
        2.243, // how unlikely a hit is by chance
        1.682,
    ],
    any: -1.402,
    score: 0.559,
    lead: 0.830,
    rival: 0.408,
    repeats: 1.285,
    repeats_odds: 0.071,
};
