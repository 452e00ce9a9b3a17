//! Radio tags: what a robot reads, and where a tag is believed to be.

use nalgebra::{Matrix2, Point2};

use crate::tag_id::TagId;

/// One range to one tag, read by a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagReading {
    /// Which tag.
    pub tag_id: TagId,
    /// Where the robot was, in its own map frame, metres.
    pub robot_position: Point2<f64>,
    /// Distance to the tag, metres.
    pub range: f64,
}

/// Where a tag is believed to be in one robot's map frame, and how surely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagEstimate {
    /// Which tag.
    pub tag_id: TagId,
    /// Best position, metres.
    pub position: Point2<f64>,
    /// Centre of the most probable cell, metres.
    pub mode: Point2<f64>,
    /// Covariance of the position in the axes of the map frame, m²: of the whole posterior, so
    /// that mirror images and rings are in it.
    pub covariance: Matrix2<f64>,
    /// Probability mass of the window of 3 × 3 cells around the best position, in [0, 1]; less
    /// where the readings do not fit the sensor's model.
    pub certainty: f64,
    /// Root mean square of the readings' residuals at the position in the sensor's sigma: about 1
    /// where the readings are as modelled.
    pub misfit: f64,
    /// Readings that went into it.
    pub readings: usize,
    /// Readings that no such sensor gives, and that were left out.
    pub dropped: usize,
    /// Whether the maximum lies at the border of the search area, where it cannot be trusted.
    pub touches_border: bool,
    /// Mass of the best window far from the winner, divided by the winner's: near 1 for the two
    /// mirror images that a straight drive leaves.
    pub second_peak_ratio: f64,
}
