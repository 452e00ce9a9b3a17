//! How a transform between two maps can be found.

/// A method of [`align_pair`](crate::align_pair).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Method {
    /// Method #3 where three tags are known well enough in both maps, else the maps alone; those
    /// also where method #3 refuses.
    #[default]
    Auto,
    /// The maps alone, by exhaustive correlation ([`grid_match`]).
    Match,
    /// Tags (Tsardoulias, Thallas, Petrou).
    Tags(TagMethod),
    /// A random walk (Carpin and Birk).
    Carpin,
    /// Wall segments that look alike, then the Radon transform (Saeedi et al.).
    Radon,
    /// None: the pose of the prior, whatever its uncertainty, or else the maps' own frames are one.
    /// What the maps say about it is reported, and never refused.
    Known,
}

/// A method of Tsardoulias, Thallas, Petrou, *Metric Map Merging using RFID Tags & Topological
/// Information*; each needs three tags that both robots localised surely, [`TwoTags`](Self::TwoTags)
/// two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TagMethod {
    /// #1: rotation and translation from three tags.
    Rfid1,
    /// #1b: least squares over the same tags; ours, as a baseline.
    Rfid1b,
    /// #2: rotation from the walls, quadrant and translation from the tags.
    Rfid2,
    /// #3: #2, refined by ICP.
    Rfid3,
    /// #3 from two tags: their direction says which quarter turn (the paper's future work).
    TwoTags,
    /// #1b, refined by ICP, without looking for straight walls (the paper's conclusions).
    TagsIcp,
}

impl Method {
    /// Every method.
    pub const ALL: [Self; 11] = [
        Self::Auto,
        Self::Match,
        Self::Tags(TagMethod::Rfid1),
        Self::Tags(TagMethod::Rfid1b),
        Self::Tags(TagMethod::Rfid2),
        Self::Tags(TagMethod::Rfid3),
        Self::Tags(TagMethod::TwoTags),
        Self::Tags(TagMethod::TagsIcp),
        Self::Carpin,
        Self::Radon,
        Self::Known,
    ];

    /// As reports and command lines call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Match => "match",
            Self::Tags(TagMethod::Rfid1) => "rfid1",
            Self::Tags(TagMethod::Rfid1b) => "rfid1b",
            Self::Tags(TagMethod::Rfid2) => "rfid2",
            Self::Tags(TagMethod::Rfid3) => "rfid3",
            Self::Tags(TagMethod::TwoTags) => "two-tags",
            Self::Tags(TagMethod::TagsIcp) => "tags-icp",
            Self::Carpin => "carpin",
            Self::Radon => "radon",
            Self::Known => "known",
        }
    }

    /// Whether it finds nothing without tags in both maps.
    #[must_use]
    pub fn needs_tags(self) -> bool {
        matches!(self, Self::Tags(_))
    }

    /// Whether it has a use for a pose that is already believed.
    #[must_use]
    pub fn takes_prior(self) -> bool {
        matches!(self, Self::Auto | Self::Match | Self::Carpin | Self::Known)
    }
}
