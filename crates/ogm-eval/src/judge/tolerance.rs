//! How near is near enough: every tolerance of the project, with its reason.

use ogm_core::Length;

use super::error::PoseError;

/// Within which an answer counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tolerance {
    /// Of the displacement.
    pub(crate) displacement: Length,
    /// Of the turn, radians.
    pub(crate) turn: f64,
    /// Of the mean squared displacement of the walls, px² of 0.02 m.
    pub(crate) walls: f64,
}

/// Maps on disk whose truth says nothing else: half the width of a door, which a robot has to find
/// again, and no better than a truth made by hand.
pub(crate) const HALF_A_DOOR: Tolerance = Tolerance::of_pose(Length::metres(0.25), 1.0);

/// What a merged map can show: one cell of the target, and the half degree by which the end of a
/// wall of six metres moves one cell of 0.05 m.
pub(crate) const STRICT: Tolerance = Tolerance::of_pose(Length::cells(1.0), 0.5);

/// Not right, but in the right place: the same room, and its walls side by side.
pub(crate) const NEAR: Tolerance = Tolerance::of_pose(Length::metres(0.5), 2.0);

/// Labelled pairs. Bent maps have no rigid truth: their displacement is a root mean square over
/// what both robots observed, and what the best rigid transform leaves comes on top.
pub(crate) const LABELLED: Tolerance = Tolerance::of_pose(Length::metres(0.4), 3.0);

/// Maps of one component that observed nothing in common: what a chain of bent maps may add up to,
/// and far from another room.
pub(crate) const UNSEEN: Tolerance = Tolerance::of_pose(Length::metres(1.5), 6.0);

/// Carpin and Birk's maps of 100 × 100 coarse cells: a walk is judged in its cells.
pub(crate) const WALK: Tolerance = Tolerance::of_pose(Length::cells(2.0), 3.0);

/// The direction of a building: twice the paper's σ of 0.56°.
pub(crate) const DIRECTION: Tolerance = Tolerance::of_pose(Length::metres(f64::INFINITY), 1.12);

/// The paper's mean over five experiments of method #3.
pub(crate) const METHOD_3: Tolerance = Tolerance::of_walls(2.6);

/// Beyond this a run has failed: walls that are off by 0.2 m no longer lie on each other.
pub(crate) const SAME_WALLS: Tolerance = Tolerance::of_walls(100.0);

impl Tolerance {
    /// A tolerance of a pose, degrees of turn.
    pub(crate) const fn of_pose(displacement: Length, degrees: f64) -> Self {
        Self { displacement, turn: degrees.to_radians(), walls: f64::INFINITY }
    }

    const fn of_walls(walls: f64) -> Self {
        Self { displacement: Length::metres(f64::INFINITY), turn: f64::INFINITY, walls }
    }

    /// Whether the error of a pose is within, on a target of `cell` metres a cell.
    pub(crate) fn admits(&self, error: PoseError, cell: f64) -> bool {
        error.displacement < self.displacement.resolve(cell) && error.turn < self.turn
    }

    /// Whether a mean squared displacement of the walls is within, px².
    pub(crate) fn admits_walls(&self, mse_disp: f64) -> bool {
        mse_disp <= self.walls
    }

    /// Whether it is outside; one that could not be measured is neither.
    pub(crate) fn excludes_walls(&self, mse_disp: f64) -> bool {
        mse_disp > self.walls
    }

    /// The wider of both, part by part.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            displacement: Length {
                metres: self.displacement.metres.max(other.displacement.metres),
                min_cells: self.displacement.min_cells.max(other.displacement.min_cells),
            },
            turn: self.turn.max(other.turn),
            walls: self.walls.max(other.walls),
        }
    }

    /// The same, wider by what the truth itself is unsure of, metres.
    pub(crate) fn besides(self, unsure: f64) -> Self {
        let Length { metres, min_cells } = self.displacement;
        Self { displacement: Length { metres: metres + unsure, min_cells }, ..self }
    }
}
