//! A straight piece of wall.

use nalgebra::Point2;

/// A straight piece of wall in a map frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One end, metres.
    pub start: Point2<f64>,
    /// The other end, metres.
    pub end: Point2<f64>,
    /// Direction of the wall in [−π/2, π/2), radians; how it was estimated is the extractor's
    /// choice and need not be that of `end - start`.
    pub direction: f64,
    /// Mean occupancy under the segment, in [0, 1]: 1 is a wall without a gap.
    pub reliability: f64,
    /// Occupied cells that support it.
    pub support: usize,
}

impl Segment {
    /// Distance between the ends, metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }
}
