//! What a score is made of, and what each part weighs.

/// Number of terms of a score.
pub const TERMS: usize = 6;

/// What the terms of a score are, in the order of [`Evidence::terms`](crate::Evidence::terms).
pub const TERM_NAMES: [&str; TERMS] = [
    "corners of wall that fit, parts giving way",
    "wall of the better map that misses, parts giving way",
    "wall of the worse map in free space, parts giving way",
    "wall that misses wall narrowly, maps as one piece",
    "overlap",
    "how unlikely a hit is by chance",
];

/// Weights of a score and of the probability that follows from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Score of a pose without evidence.
    pub bias: f64,
    /// Of each of [`Evidence::terms`](crate::Evidence::terms), none below zero.
    pub terms: [f64; TERMS],
    /// Log-odds that one of the poses found is right, where the best scores 0 without a lead.
    pub any: f64,
    /// Per score of the best.
    pub score: f64,
    /// Per lead over the second.
    pub lead: f64,
    /// Taken off per score of a second that fits as well.
    pub rival: f64,
    /// Taken off the log-odds where it is known that the building repeats itself, after
    /// [`repeats_odds`](Self::repeats_odds) of them is kept: there even a good fit is little proof.
    pub repeats: f64,
    /// Share of the log-odds that is kept there, at most 1.
    pub repeats_odds: f64,
}
