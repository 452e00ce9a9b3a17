//! The knobs, with their units and where their defaults come from.

use nalgebra::Point2;

/// How a tag filter models the sensor and reads its own posterior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilterParams {
    /// Metres a cell of the search area. 0.02 up to a sigma of 0.05 m and in proportion to larger
    /// ones, so that a certainty says the same about every reader; independent of the map's
    /// resolution.
    pub cell_size: f64,
    /// Cells a side of the search area: 326, so that a tag that is first read at the longest range
    /// lies inside with four sigma of noise. The paper's 300 (section 3) put it on the border.
    pub side_cells: usize,
    /// Standard deviation of a range, metres: 0.05 (section 3). Also the width of the likelihood
    /// annulus.
    pub range_sigma: f64,
    /// Longest true range, metres: 3 (section 3). A measured range may exceed it by 4 sigma.
    pub max_range: f64,
    /// What a residual costs.
    pub likelihood: Likelihood,
    /// Whether readings that do not fit the model lower the certainty and widen the covariance:
    /// yes. The paper believes its model.
    pub check_fit: bool,
    /// Which windows compete for the certainty.
    pub window: CertaintyWindow,
    /// Where in the winning window the tag is said to be.
    pub position: PositionRule,
    /// Cells a side of the certainty window: 3 (section 3, K).
    pub sub_sampling: usize,
}

impl Default for FilterParams {
    fn default() -> Self {
        Self::for_reader(3.0, 0.05)
    }
}

/// Cells between the furthest place of a tag and the border: those that count as the border, and
/// one for the robot's place in its own cell.
const BORDER_CELLS: f64 = 3.0;

impl FilterParams {
    /// The parameters for a reader with this longest range and this standard deviation of a range,
    /// metres.
    #[must_use]
    pub fn for_reader(max_range: f64, range_sigma: f64) -> Self {
        let cell_size = (0.4 * range_sigma).max(0.02);
        let reach = ((max_range + RANGE_SLACK_SIGMA * range_sigma) / cell_size).ceil();
        Self {
            cell_size,
            side_cells: whole(2.0 * (reach + BORDER_CELLS)),
            range_sigma,
            max_range,
            likelihood: Likelihood::Truncated,
            check_fit: true,
            window: CertaintyWindow::Sliding,
            position: PositionRule::WindowCentroid,
            sub_sampling: 3,
        }
    }

    /// 300 cells a side, a Gaussian annulus that is believed, certainty from disjoint blocks and
    /// position from the most probable cell, as printed.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            side_cells: 300,
            likelihood: Likelihood::Gaussian,
            check_fit: false,
            window: CertaintyWindow::Disjoint,
            position: PositionRule::Mode,
            ..Self::default()
        }
    }
}

/// Measured ranges may exceed the maximum range by this many sigma.
pub(crate) const RANGE_SLACK_SIGMA: f64 = 4.0;

/// Zero where nothing can be meant; the filter says what is wrong.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, and a grid of so many cells is refused"
)]
fn whole(cells: f64) -> usize {
    cells as usize
}

/// What a reading costs a place that it does not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Likelihood {
    /// Half the square of the residual in sigma, and no more beyond three of them, so that echoes
    /// and other outliers pull at nothing. Up to a quarter of the readings may be such without
    /// lowering the certainty.
    #[default]
    Truncated,
    /// Half the square of the residual in sigma, however large: the annulus of the paper, which
    /// one echo in ten pulls off by 0.1 m.
    Gaussian,
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

impl TagOnlyParams {
    /// Rotation and translation as section 5.2 prints them, in the map frames.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            rotation: TagOnlyRotation::AsPrinted,
            translation: TagOnlyTranslation::AsPrinted,
            ..Self::default()
        }
    }
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
