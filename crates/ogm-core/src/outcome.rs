//! What a search gives back when its input was valid.

/// Either what was looked for, or why it cannot be said.
///
/// A valid map or tag set that holds too little is not an error and never an identity transform:
/// it is a refusal with its reason.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub enum Outcome<T> {
    /// What was looked for.
    Found(T),
    /// Valid input that does not determine an answer.
    Refused(Refusal),
}

impl<T> Outcome<T> {
    /// The result, if there is one.
    #[must_use]
    pub fn found(self) -> Option<T> {
        match self {
            Self::Found(value) => Some(value),
            Self::Refused(_) => None,
        }
    }

    /// The reason, if it was refused.
    #[must_use]
    pub fn refusal(&self) -> Option<&Refusal> {
        match self {
            Self::Found(_) => None,
            Self::Refused(refusal) => Some(refusal),
        }
    }

    /// The same outcome as a `Result`, for `?` inside a pipeline that refuses where a step does.
    ///
    /// # Errors
    /// The refusal.
    pub fn into_result(self) -> Result<T, Refusal> {
        match self {
            Self::Found(value) => Ok(value),
            Self::Refused(refusal) => Err(refusal),
        }
    }
}

impl<T> From<Result<T, Refusal>> for Outcome<T> {
    fn from(result: Result<T, Refusal>) -> Self {
        match result {
            Ok(value) => Self::Found(value),
            Err(refusal) => Self::Refused(refusal),
        }
    }
}

/// Why valid input gives no answer, with the numbers behind it and what would help.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// Too few occupied cells to say anything about walls.
    #[error("too little structure: {have} occupied cells, at least {need} needed; explore further")]
    TooLittleStructure {
        /// Occupied cells found.
        have: usize,
        /// Occupied cells needed.
        need: usize,
    },
    /// Too few tags that both maps know, or that lie apart.
    #[error(
        "too few tags: {have} usable in both maps, {need} needed; let both robots pass more tags"
    )]
    TooFewTags {
        /// Usable tags.
        have: usize,
        /// Tags needed.
        need: usize,
    },
    /// Tags that are known in both maps, but not surely enough.
    #[error(
        "low certainty: {best:.3} where more than {need:.2} is needed; drive curves past the tags"
    )]
    LowCertainty {
        /// Certainty reached by the pair that fails its threshold.
        best: f64,
        /// Certainty that it must exceed.
        need: f64,
    },
    /// Tags that lie too close together to fix a rotation.
    #[error(
        "tags coincide: they spread {spread_m:.3} m, at least {need_m:.3} m needed; use tags further apart"
    )]
    TagsCoincide {
        /// Largest distance from the tags' centroid, metres.
        spread_m: f64,
        /// Distance needed, metres.
        need_m: f64,
    },
    /// No straight wall survived the extraction.
    #[error("no lines: {candidates} candidate walls, none long and reliable enough")]
    NoLines {
        /// Walls before the last filter.
        candidates: usize,
    },
    /// The maps share too little where they were laid over each other.
    #[error("no overlap: {have} matching wall cells, at least {need} needed")]
    NoOverlap {
        /// Pairs of wall cells found.
        have: usize,
        /// Pairs needed.
        need: usize,
    },
    /// The maps disagree where they overlap.
    #[error("contradiction: {conflicts} of {compared} wall cells find no wall in the other map")]
    Contradiction {
        /// Wall cells without a wall nearby in the other map.
        conflicts: usize,
        /// Wall cells that lie where the other map knows.
        compared: usize,
    },
    /// The best answer, without a rival, is not sure enough.
    #[error(
        "unlikely: the best transform is right with probability {probability:.2} where {need:.2} is needed; give a prior or explore further"
    )]
    Unlikely {
        /// Probability that it is right.
        probability: f64,
        /// Least probability to believe it.
        need: f64,
    },
    /// More than one answer fits.
    #[error(
        "ambiguous: evidence differs by {residual_rad:.3} rad from the chosen quarter turn, at most {limit_rad:.3} allowed"
    )]
    Ambiguous {
        /// Angle between the tags' rotation and the walls', radians.
        residual_rad: f64,
        /// Largest angle that is accepted, radians.
        limit_rad: f64,
    },
    /// Several poses fit about as well.
    #[error(
        "ambiguous: {poses} poses fit about as well, the best is right with probability {probability:.2} where {need:.2} is needed; give a prior or explore further"
    )]
    SeveralPoses {
        /// Poses that fit, the best among them.
        poses: usize,
        /// Probability of the best.
        probability: f64,
        /// Probability needed.
        need: f64,
    },
    /// A refinement that left the neighbourhood of its start, or made it worse.
    #[error(
        "not converged: refinement ran away after {iterations} iterations with {rmse_m:.3} m between the walls; check the start"
    )]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Root mean square distance of the last pairs, metres.
        rmse_m: f64,
    },
}
