//! The knobs, with their units and where their defaults come from.

use nalgebra::Point2;

/// How a tag filter models the sensor and reads its own posterior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilterParams {
    /// Metres a cell of the search area. 0.02, so that [`side_cells`](Self::side_cells) of them
    /// span twice the sensor's range; independent of the map's resolution.
    pub cell_size: f64,
    /// Cells a side of the search area: 300 (section 3), 6 m at 0.02 m.
    pub side_cells: usize,
    /// Standard deviation of a range, metres: 0.05 (section 3). Also the width of the likelihood
    /// annulus.
    pub range_sigma: f64,
    /// Longest true range, metres: 3 (section 3). A measured range may exceed it by 4 sigma.
    pub max_range: f64,
    /// Which windows compete for the certainty.
    pub window: CertaintyWindow,
    /// Where in the winning window the tag is said to be.
    pub position: PositionRule,
    /// Cells a side of the certainty window: 3 (section 3, K).
    pub sub_sampling: usize,
}

impl Default for FilterParams {
    fn default() -> Self {
        Self {
            cell_size: 0.02,
            side_cells: 300,
            range_sigma: 0.05,
            max_range: 3.0,
            window: CertaintyWindow::Sliding,
            position: PositionRule::WindowCentroid,
            sub_sampling: 3,
        }
    }
}

impl FilterParams {
    /// Certainty from disjoint blocks and position from the most probable cell, as printed.
    #[must_use]
    pub fn paper() -> Self {
        Self { window: CertaintyWindow::Disjoint, position: PositionRule::Mode, ..Self::default() }
    }
}

/// Which windows compete for the certainty of a tag.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CertaintyWindow {
    /// Every window of cells: a well located tag is certain wherever it lies.
    #[default]
    Sliding,
    /// Blocks side by side, as sub-sampling by K gives them: a tag at the corner of a block never
    /// exceeds 0.25.
    Disjoint,
}

/// Where in its posterior a tag is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PositionRule {
    /// The probability-weighted centroid of the winning window: finer than a cell while the
    /// posterior is wider than about half of one, and nearly the cell's centre once it is narrower.
    #[default]
    WindowCentroid,
    /// The centre of the most probable cell, as printed.
    Mode,
}

/// How sure the common tags must be before two maps are merged by them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelectionParams {
    /// The most certain pair must exceed this: 0.90 (section 4.2).
    pub best_above: f64,
    /// The third pair must exceed this: 0.75 (section 4).
    pub third_above: f64,
    /// Tags nearer to a better one are passed over while others are sure enough, metres: 0.5,
    /// the shortest lever that a direction is read from. The paper takes the three surest
    /// wherever they lie, which is 0.
    pub min_separation: f64,
}

impl Default for SelectionParams {
    fn default() -> Self {
        Self { best_above: 0.90, third_above: 0.75, min_separation: 0.5 }
    }
}

/// When tags lie well enough to read a direction from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationParams {
    /// Shortest lever that a direction is read from, metres: 0.5, where 2 cm of tag error turn the
    /// direction by 2.3°.
    pub min_arm: f64,
    /// Distances between two tags may differ between the maps by this many metres: 0.1, twice the
    /// sigma of a range…
    pub distance_tolerance: f64,
    /// …or by this share of the distance, whichever is more: 0.05.
    pub distance_tolerance_share: f64,
}

impl Default for RotationParams {
    fn default() -> Self {
        Self { min_arm: 0.5, distance_tolerance: 0.1, distance_tolerance_share: 0.05 }
    }
}

/// The transform from tags alone (section 5.2, method #1), corrected or as printed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TagOnlyParams {
    /// Which direction is compared between the maps.
    pub rotation: TagOnlyRotation,
    /// Which translation follows the rotation.
    pub translation: TagOnlyTranslation,
    /// In which coordinates the formulas are evaluated; the corrected ones do not depend on it.
    pub frame: TagFrame,
    /// What the source is turned about; the corrected translation does not depend on it.
    pub centre: RotationCentre,
    /// The shortest lever of a direction.
    pub levers: RotationParams,
}

/// Which direction the rotation from tags alone compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TagOnlyRotation {
    /// From the midpoint of the two best tags to the third (Eqs. 5, 6).
    #[default]
    P3,
    /// From the midpoint of the two best tags to the second: the direction of that pair.
    P2,
    /// To the second tag with the y of the midpoint in both arguments, as section 5.2 prints it.
    /// Wrong unless x and y of the midpoint agree.
    AsPrinted,
}

/// Which translation follows the rotation from tags alone; C is the centroid of the three tags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TagOnlyTranslation {
    /// C₁ − R C₂: the centroids coincide afterwards.
    #[default]
    Corrected,
    /// C₁ − C₂: right sign, centroid not rotated. Exact for [`RotationCentre::TagCentroid`] only.
    SignFixed,
    /// C₂ − C₁, as section 5.2 prints it.
    AsPrinted,
}

/// In which coordinates the transform from tags alone is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum TagFrame {
    /// The map frames themselves, whose origins are the start poses.
    #[default]
    StartPose,
    /// Coordinates from the lower-left corners of the cropped maps.
    Cropped {
        /// Corner of the target map, metres in its map frame.
        target_corner: Point2<f64>,
        /// Corner of the source map, metres in its map frame.
        source_corner: Point2<f64>,
    },
}

/// What the source map is turned about.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum RotationCentre {
    /// The origin of the [`TagFrame`].
    #[default]
    Origin,
    /// A point of the source map frame, metres; such as the centre of the cropped map.
    At(Point2<f64>),
    /// The centroid of the three tags.
    TagCentroid,
}
