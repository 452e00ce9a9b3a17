//! The best of a search for the nearest point, while it goes on.

/// The nearest point so far, and how far away the others are at least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    pub(crate) index: u32,
    pub(crate) distance_sq: f64,
    /// Every other point is at least this far away.
    pub(crate) others_sq: f64,
}

impl Nearest {
    /// No point yet; one at most `radius` away will do.
    pub(crate) fn none_within(radius: f64) -> Self {
        Self { index: u32::MAX, distance_sq: radius * radius, others_sq: radius * radius }
    }

    /// The point `index` so far; others are of interest up to `slack` further away.
    pub(crate) fn hint(index: u32, distance_sq: f64, slack: f64) -> Self {
        let others = distance_sq.sqrt() + slack;
        Self { index, distance_sq, others_sq: others * others }
    }

    pub(crate) fn is_found(&self) -> bool {
        self.index != u32::MAX
    }

    /// Takes one more point into account; the lower index wins at equal distance.
    pub(crate) fn improve(&mut self, index: u32, distance_sq: f64) {
        if distance_sq > self.others_sq || index == self.index {
            return;
        }
        let is_nearer = distance_sq < self.distance_sq
            || (distance_sq == self.distance_sq && index < self.index);
        if is_nearer {
            self.others_sq = self.distance_sq;
            self.index = index;
            self.distance_sq = distance_sq;
        } else {
            self.others_sq = distance_sq;
        }
    }
}
