//! What is known about a pose, in metres of wall.

/// What a pose has for it and against it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Evidence {
    /// Wall of one map on wall of the other, metres, mean of both directions.
    pub hit_m: f64,
    /// Wall of one map close to wall of the other, but in its free space, metres.
    pub near_miss_m: f64,
    /// Wall of one map in free space of the other, far from any wall, metres.
    pub conflict_m: f64,
    /// Free in both, square metres.
    pub free_m2: f64,
    /// Known in both over known in the smaller one.
    pub overlap: f64,
    /// Of [`hit_m`](Self::hit_m), seen from the same side.
    pub same_side_m: f64,
    /// Of [`hit_m`](Self::hit_m), seen from opposite sides, as two rooms behind one wall do.
    pub opposite_side_m: f64,
    /// Share of what both maps know that lies within a hit of some wall: how often a hit is chance.
    pub chance: f64,
    /// The walls once every part of a map may give way a little.
    pub relaxed: Relaxed,
}

/// Walls of maps that may each be bent by drift: parts of one, about the size of a room, move to
/// where they fit best on the other, up to half a metre.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Relaxed {
    /// The walls of each map on the other, those that fit worse first.
    pub walls: [WallFit; 2],
    /// Corners that fit, mean of both directions: places of a metre where more than twice as much
    /// wall fits as misses and what fits runs in more than one direction; each counts up to one.
    /// Near zero in a corridor.
    pub corners: f64,
    /// Root mean square by which the parts moved, metres.
    pub moved_m: f64,
}

/// Walls of one map on the other, metres.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WallFit {
    /// On wall.
    pub hit_m: f64,
    /// Close to wall, but in free space.
    pub near_miss_m: f64,
    /// In free space, far from any wall.
    pub conflict_m: f64,
}

impl Relaxed {
    /// The walls of both maps, their mean.
    #[must_use]
    pub fn mean(&self) -> WallFit {
        let mean = |value: fn(&WallFit) -> f64| 0.5 * self.walls.iter().map(value).sum::<f64>();
        WallFit {
            hit_m: mean(|walls| walls.hit_m),
            near_miss_m: mean(|walls| walls.near_miss_m),
            conflict_m: mean(|walls| walls.conflict_m),
        }
    }
}

impl WallFit {
    /// All that does not fit.
    #[must_use]
    pub fn against_m(&self) -> f64 {
        self.near_miss_m + self.conflict_m
    }

    /// Share of the compared wall that does not fit.
    pub(crate) fn misfit(&self) -> f64 {
        self.against_m() / (self.hit_m + self.against_m()).max(1e-9)
    }
}

impl Evidence {
    /// Whether enough of both maps lies on each other to say anything: free space on free space,
    /// and walls seen from the same side. Wall without a side is noise, and where wall is
    /// everywhere, as it seems on very coarse cells, wall on wall says nothing.
    #[must_use]
    pub fn is_comparable(&self) -> bool {
        self.is_promising()
            && self.same_side_m >= 0.5
            && self.same_side_m >= 0.4 * self.sided_m()
            && self.same_side_m >= 0.2 * self.hit_m
    }

    /// Whether a pose that is off by the thickness of a wall may become comparable: two maps of the
    /// rooms on either side of one then show it from the wrong sides.
    pub(crate) fn is_promising(&self) -> bool {
        self.free_m2 >= 0.5 && self.sided_m() >= 0.5 && self.chance <= 0.6
    }

    fn sided_m(&self) -> f64 {
        self.same_side_m + self.opposite_side_m
    }

    /// Share of the compared wall that fits.
    #[must_use]
    pub fn agreement(&self) -> f64 {
        let compared = self.hit_m + self.near_miss_m + self.conflict_m;
        if compared > 0.0 { self.hit_m / compared } else { 0.0 }
    }
}
