//! Why valid input gives no answer.

use std::fmt;

/// Why valid input gives no answer, with the numbers behind it and what would help.
///
/// `Display` is [`kind`](Self::kind), a colon and [`detail`](Self::detail).
///
/// ```
/// use ogm_core::Refusal;
///
/// let refusal = Refusal::NoOverlap { have_m: 1.25, need_m: 3.0 };
/// assert_eq!(refusal.kind(), "no overlap");
/// assert_eq!(refusal.detail(), "1.2 m of wall match, at least 3.0 m needed");
/// assert!(!refusal.is_ambiguous());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// Too few occupied cells to say anything about walls.
    TooLittleStructure {
        /// Occupied cells found.
        have: usize,
        /// Occupied cells needed.
        need: usize,
    },
    /// Too little wall to say anything about a map.
    TooLittleWall {
        /// Metres of wall found.
        have_m: f64,
        /// Metres of wall needed.
        need_m: f64,
    },
    /// Too little free space in one piece.
    TooLittleFreeSpace {
        /// Square metres found.
        have_m2: f64,
        /// Square metres needed.
        need_m2: f64,
    },
    /// Too few tags that both maps know, or that lie apart.
    TooFewTags {
        /// Usable tags.
        have: usize,
        /// Tags needed.
        need: usize,
    },
    /// Tags that are known in both maps, but not surely enough.
    LowCertainty {
        /// Certainty reached by the pair that fails its threshold.
        best: f64,
        /// Certainty that it must exceed.
        need: f64,
    },
    /// Tags that lie too close together to fix a rotation.
    TagsCoincide {
        /// Largest distance from the tags' centroid, metres.
        spread_m: f64,
        /// Distance needed, metres.
        need_m: f64,
    },
    /// Tags that the maps place differently to each other, or to the answer.
    TagsDisagree {
        /// Root mean square distance of tags from each other that should lie together, metres.
        residual_m: f64,
        /// Largest that is accepted, metres.
        limit_m: f64,
    },
    /// No straight wall survived the extraction.
    NoLines {
        /// Walls before the last filter.
        candidates: usize,
    },
    /// The maps share too little wall where they were laid over each other.
    NoOverlap {
        /// Metres of wall that match.
        have_m: f64,
        /// Metres needed.
        need_m: f64,
    },
    /// The maps agree on too small an area where they were laid over each other.
    TooLittleSharedArea {
        /// Square metres on which they agree.
        have_m2: f64,
        /// Square metres needed.
        need_m2: f64,
    },
    /// Too few points of one map lie near points of the other.
    TooFewPairs {
        /// Pairs of points found.
        have: usize,
        /// Pairs needed.
        need: usize,
    },
    /// No segment of wall of one map looks like one of the other.
    NoAlikeSegments {
        /// Pairs of segments that were compared.
        compared: usize,
    },
    /// The maps were never laid over each other so that they could be compared.
    NothingCompared,
    /// The walls of the maps disagree where they overlap.
    Contradiction {
        /// Wall cells without a wall nearby in the other map.
        conflicts: usize,
        /// Wall cells that lie where the other map knows.
        compared: usize,
    },
    /// The walls of the maps disagree where they overlap.
    ConflictingWalls {
        /// Metres of wall in free space of the other map.
        conflict_m: f64,
        /// Metres of wall that lie where the other map knows.
        compared_m: f64,
    },
    /// The cells of the maps disagree where both are known.
    ConflictingCells {
        /// Cells that are free in one map and occupied in the other.
        conflicts: usize,
        /// Cells that are known in both.
        compared: usize,
    },
    /// The least entropy lies elsewhere than the best fit.
    EntropyElsewhere {
        /// Cells between them.
        cells: u64,
        /// Most that are accepted.
        limit: u64,
    },
    /// The walls fit about as well when they slide along each other.
    Slides {
        /// Share of the walls that still coincide a few cells away.
        share: f64,
        /// Largest share that is accepted.
        limit: f64,
    },
    /// The best answer, without a rival, is not sure enough.
    Unlikely {
        /// Probability that it is right.
        probability: f64,
        /// Least probability to believe it.
        need: f64,
    },
    /// More than one answer fits.
    Ambiguous {
        /// Angle between the tags' rotation and the walls', radians.
        residual_rad: f64,
        /// Largest angle that is accepted, radians.
        limit_rad: f64,
    },
    /// Several poses fit about as well, and none is likely enough.
    SeveralPoses {
        /// Poses that fit, the best among them.
        poses: usize,
        /// Probability of the best.
        probability: f64,
        /// Probability needed.
        need: f64,
    },
    /// The search ended at its limit of work, so that a better answer may be among what was not
    /// tried.
    SearchCut {
        /// Work done, in the units of the limit.
        work: u64,
    },
    /// Several poses pass every test, and nothing says which is right.
    SeveralVerified {
        /// Poses that pass.
        poses: usize,
    },
    /// A refinement that left the neighbourhood of its start, or made it worse.
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Root mean square distance of the last pairs, metres.
        rmse_m: f64,
    },
    /// A translation whose best place lay at the edge of every window that was searched.
    AtTheRim {
        /// Cells between the middle of a window and its edge.
        radius: usize,
    },
}

impl Refusal {
    /// What kind of reason it is, in a few words without numbers.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::TooLittleStructure { .. } | Self::TooLittleWall { .. } => "too little structure",
            Self::TooLittleFreeSpace { .. } => "too little free space",
            Self::TooFewTags { .. } => "too few tags",
            Self::LowCertainty { .. } => "low certainty",
            Self::TagsCoincide { .. } => "tags coincide",
            Self::NoLines { .. } => "no lines",
            Self::NoOverlap { .. }
            | Self::TooLittleSharedArea { .. }
            | Self::TooFewPairs { .. }
            | Self::NoAlikeSegments { .. }
            | Self::NothingCompared => "no overlap",
            Self::TagsDisagree { .. }
            | Self::Contradiction { .. }
            | Self::ConflictingWalls { .. }
            | Self::ConflictingCells { .. }
            | Self::EntropyElsewhere { .. } => "contradiction",
            Self::Slides { .. } => "unobservable",
            Self::SearchCut { .. } => "search cut",
            Self::Unlikely { .. } => "unlikely",
            Self::Ambiguous { .. } | Self::SeveralPoses { .. } | Self::SeveralVerified { .. } => {
                "ambiguous"
            }
            Self::NotConverged { .. } | Self::AtTheRim { .. } => "not converged",
        }
    }

    /// Whether there are answers, but several: a prior may decide, where otherwise only other maps
    /// would.
    #[must_use]
    pub fn is_ambiguous(&self) -> bool {
        self.kind() == "ambiguous"
    }

    /// The numbers behind it and what would help, without the kind.
    #[must_use]
    pub fn detail(&self) -> String {
        match *self {
            Self::TooLittleStructure { have, need } => {
                format!("{have} occupied cells, at least {need} needed; explore further")
            }
            Self::SearchCut { work } => {
                format!("the limit of {work} units of work left something untried; raise it")
            }
            Self::TooLittleWall { have_m, need_m } => {
                format!("{have_m:.1} m of wall, at least {need_m:.1} m needed; explore further")
            }
            Self::TooLittleFreeSpace { have_m2, need_m2 } => {
                format!("{have_m2:.2} m² in one piece, at least {need_m2:.2} m² needed")
            }
            Self::TooFewTags { have, need } => {
                format!("{have} usable in both maps, {need} needed; let both robots pass more tags")
            }
            Self::LowCertainty { best, need } => {
                format!("{best:.3} where more than {need:.2} is needed; drive curves past the tags")
            }
            Self::TagsCoincide { spread_m, need_m } => format!(
                "they spread {spread_m:.3} m, at least {need_m:.3} m needed; use tags further apart"
            ),
            Self::TagsDisagree { residual_m, limit_m } => format!(
                "the tags of the maps stay {residual_m:.2} m apart, at most {limit_m:.2} m accepted: one was moved, or these are two buildings"
            ),
            Self::NoLines { candidates } => {
                format!("{candidates} candidate walls, none long and reliable enough")
            }
            Self::NoOverlap { have_m, need_m } => {
                format!("{have_m:.1} m of wall match, at least {need_m:.1} m needed")
            }
            Self::TooLittleSharedArea { have_m2, need_m2 } => {
                format!("the maps agree on {have_m2:.1} m², at least {need_m2:.1} m² needed")
            }
            Self::TooFewPairs { have, need } => {
                format!("{have} pairs of wall points, at least {need} needed")
            }
            Self::NoAlikeSegments { compared } => {
                format!("of {compared} pairs of wall segments none look alike")
            }
            Self::NothingCompared => "nothing known of both maps came to lie together".to_owned(),
            Self::Contradiction { conflicts, compared } => {
                format!("{conflicts} of {compared} wall cells find no wall in the other map")
            }
            Self::ConflictingWalls { conflict_m, compared_m } => format!(
                "{conflict_m:.1} of {compared_m:.1} m of wall lie in free space of the other map"
            ),
            Self::ConflictingCells { conflicts, compared } => {
                format!("{conflicts} of {compared} cells known in both maps differ")
            }
            Self::EntropyElsewhere { cells, limit } => format!(
                "the least entropy lies {cells} cells from the best fit, at most {limit} accepted"
            ),
            Self::Slides { share, limit } => format!(
                "{share:.2} of the walls still coincide when the maps slide along each other, at most {limit:.2} accepted"
            ),
            Self::Unlikely { probability, need } => format!(
                "the best transform is right with probability {probability:.2} where {need:.2} is needed; give a prior or explore further"
            ),
            Self::Ambiguous { residual_rad, limit_rad } => format!(
                "evidence differs by {residual_rad:.3} rad from the chosen quarter turn, at most {limit_rad:.3} allowed"
            ),
            Self::SeveralPoses { poses, probability, need } => format!(
                "{poses} poses fit about as well, the best is right with probability {probability:.2} where {need:.2} is needed; give a prior or explore further"
            ),
            Self::SeveralVerified { poses } => {
                format!("{poses} poses pass every test and nothing says which is right")
            }
            Self::NotConverged { iterations, rmse_m } => format!(
                "refinement ran away after {iterations} iterations with {rmse_m:.3} m between the walls; check the start"
            ),
            Self::AtTheRim { radius } => {
                format!(
                    "the best translation stayed at the edge of its window, {radius} cells away"
                )
            }
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind(), self.detail())
    }
}

impl std::error::Error for Refusal {}
