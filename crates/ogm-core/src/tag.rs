//! Radio tags: what a robot reads, and where a tag is believed to be.

use nalgebra::Point2;

/// One range to one tag, read by a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagReading {
    /// Which tag.
    pub tag_id: u32,
    /// Where the robot was, in its own map frame, metres.
    pub robot_position: Point2<f64>,
    /// Distance to the tag, metres.
    pub range: f64,
}

/// Where a tag is believed to be in one robot's map frame, and how surely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagEstimate {
    /// Which tag.
    pub tag_id: u32,
    /// Best position, metres.
    pub position: Point2<f64>,
    /// Centre of the most probable cell, metres.
    pub mode: Point2<f64>,
    /// Probability mass of the window of 3 × 3 cells around the best position, in [0, 1].
    pub certainty: f64,
    /// Readings that went into it.
    pub readings: usize,
    /// Whether the maximum lies at the border of the search area, where it cannot be trusted.
    pub touches_border: bool,
    /// Mass of the best window far from the winner, divided by the winner's: near 1 for the two
    /// mirror images that a straight drive leaves.
    pub second_peak_ratio: f64,
}
