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
    /// Metres of matched wall that resist a shift of their part in the direction that it resists
    /// least, mean of both directions: near zero in a corridor, much where there are corners.
    pub cross_m: f64,
    /// Parts of the maps that fit, mean of both directions: each counts up to one, where more than
    /// twice as much of its wall fits as stands in free space.
    pub fitting: f64,
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

/// Rate at which probability is lost with the share of a map's wall that does not fit, above half.
const CONTRADICTION: f64 = 20.0;
/// Parts that fit with which a contradiction counts by half: an empty room has few, and where a
/// dozen fit one map shows what was moved or left out of the other.
const BORNE_OUT: f64 = 8.0;

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

    /// Share of the probability that is left where the walls of one map contradict the pose: more
    /// of them stand in free space of the other than on wall, and few parts fit. An empty room
    /// fits so into many buildings, and what the weights learnt does not reach so far.
    pub(crate) fn uncontradicted(&self) -> f64 {
        let most = self.relaxed.walls.iter().map(WallFit::misfit).fold(0.0, f64::max);
        let lost = 1.0 - (-CONTRADICTION * (most - 0.5).max(0.0)).exp();
        1.0 - lost / (1.0 + (self.relaxed.fitting / BORNE_OUT).powi(4))
    }

    /// Share of the compared wall that fits.
    #[must_use]
    pub fn agreement(&self) -> f64 {
        let compared = self.hit_m + self.near_miss_m + self.conflict_m;
        if compared > 0.0 { self.hit_m / compared } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::{Evidence, Relaxed, WallFit};
    use proptest::prelude::{prop_assert, proptest};

    fn kept(hit_m: f64, near_miss_m: f64, conflict_m: f64, fitting: f64) -> f64 {
        let agrees = WallFit { hit_m: 20.0, ..WallFit::default() };
        let walls = [WallFit { hit_m, near_miss_m, conflict_m }, agrees];
        Evidence {
            relaxed: Relaxed { walls, fitting, ..Relaxed::default() },
            ..Evidence::default()
        }
        .uncontradicted()
    }

    proptest! {
        #[test]
        fn a_map_contradicts_a_pose_once_more_of_its_wall_misses_than_fits(
            hit_m in 0.1_f64..50.0, near_miss_m in 0.0_f64..50.0, conflict_m in 0.0_f64..50.0,
            more in 0.1_f64..20.0, fitting in 0.0_f64..30.0,
        ) {
            let kept = |hit_m, conflict_m, fitting| kept(hit_m, near_miss_m, conflict_m, fitting);
            let before = kept(hit_m, conflict_m, fitting);
            let is_contradicted = near_miss_m + conflict_m > hit_m;
            prop_assert!((before < 1.0) == is_contradicted && before > 0.0);
            prop_assert!(kept(hit_m + more, conflict_m, fitting) >= before);
            prop_assert!(kept(hit_m, conflict_m + more, fitting) <= before);
            prop_assert!(kept(hit_m, conflict_m, fitting + more) >= before);
        }
    }

    #[test]
    fn where_two_thirds_of_a_maps_wall_miss_few_parts_make_no_pose_sure_but_many_do() {
        assert!(kept(10.0, 0.0, 20.0, 2.0) < 0.05);
        assert!(kept(100.0, 0.0, 200.0, 20.0) > 0.95);
    }
}
