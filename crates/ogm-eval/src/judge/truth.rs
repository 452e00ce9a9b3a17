//! What is true of two maps, and how sure that is.

use nalgebra::{Point2, Vector2};
use ogm_core::Se2;
use ogm_sim::PairTruth;

use super::error::{PoseError, TransformError};
use super::overlap::Overlap;
use super::tolerance::{LABELLED, Tolerance};

/// The true transform between two maps and how near to it an answer is right.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Truth {
    pub(crate) target_from_source: Se2,
    /// Where errors are taken, source frame: the centroid of what is judged.
    pub(crate) centre: Point2<f64>,
    /// Root mean square distance of what is judged from its centroid, metres; 0 for one point.
    pub(crate) radius: f64,
    /// Metres a cell of the target.
    pub(crate) cell: f64,
    /// Within which an answer is right.
    pub(crate) tolerance: Tolerance,
    /// Whether both maps share one corrected trajectory, so that the truth is exact.
    pub(crate) exact: bool,
}

impl Truth {
    /// That of a simulated pair, whose maps may be bent.
    pub(crate) fn of_simulated(truth: &PairTruth, cell: f64, exact: bool) -> Self {
        Self {
            target_from_source: truth.target_from_source,
            centre: truth.shared_centre,
            radius: truth.shared_radius,
            cell,
            tolerance: LABELLED.besides(truth.residual),
            exact,
        }
    }

    /// That of two maps that their robots' drift has bent: the rigid motion that brings places of
    /// the source nearest to where the same places are in the target, within what it leaves. `None`
    /// of fewer than two different places.
    pub(crate) fn of_places(places: &[[Point2<f64>; 2]], cell: f64) -> Option<Self> {
        let count = places.len() as f64;
        let [target_centre, centre] = [0, 1].map(|which| {
            let sum: Vector2<f64> = places.iter().map(|place| place[which].coords).sum();
            Point2::from(sum / count)
        });
        let (mut dot, mut cross, mut squares) = (0.0, 0.0, 0.0);
        for [target, source] in places {
            let (target, source) = (target - target_centre, source - centre);
            dot += source.dot(&target);
            cross += source.perp(&target);
            squares += source.norm_squared();
        }
        let is_held = squares > 0.0 && dot.hypot(cross) > 0.0;
        let turn = Se2::new(0.0, 0.0, cross.atan2(dot));
        let shift = target_centre - turn * centre;
        let target_from_source = Se2::new(shift.x, shift.y, turn.theta());
        let left = places
            .iter()
            .map(|[target, source]| (target - target_from_source * *source).norm_squared());
        let residual = (left.sum::<f64>() / count).sqrt();
        is_held.then(|| Self {
            target_from_source,
            centre,
            radius: (squares / count).sqrt(),
            cell,
            tolerance: LABELLED.besides(residual),
            exact: false,
        })
    }

    /// The error of a pose: root mean square over what is judged.
    pub(crate) fn error(&self, target_from_source: &Se2) -> PoseError {
        let at_centre = PoseError::at(self.centre, target_from_source, &self.target_from_source);
        let turn = at_centre.turn;
        let displacement = at_centre.displacement.hypot(2.0 * (turn / 2.0).sin() * self.radius);
        PoseError { displacement, turn }
    }

    /// The error of a pose and of the walls under it.
    pub(crate) fn errors(&self, overlap: &Overlap, target_from_source: &Se2) -> TransformError {
        let pose = self.error(target_from_source);
        TransformError { pose, ..overlap.errors(target_from_source) }
    }

    /// Whether an error is within the tolerance.
    pub(crate) fn admits(&self, error: PoseError) -> bool {
        self.tolerance.admits(error, self.cell)
    }
}

#[cfg(test)]
mod tests {
    use super::Truth;
    use nalgebra::Point2;
    use ogm_core::Se2;
    use ogm_sim::PairTruth;

    #[test]
    fn places_give_back_the_motion_between_them_and_what_it_leaves() {
        let truth = Se2::new(3.0, -2.0, 2.5);
        let source = [[0.0, 0.0], [4.0, 1.0], [1.0, 5.0], [-2.0, 3.0]].map(Point2::from);
        let exact = source.map(|point| [truth * point, point]);
        let found = Truth::of_places(&exact, 0.05).unwrap();
        let error = found.error(&truth);
        assert!(error.displacement < 1e-12 && error.turn < 1e-12);
        assert!((found.tolerance.displacement.metres - 0.4).abs() < 1e-12);
        let mut bent = exact;
        bent[0][0].x += 0.4;
        let bent = Truth::of_places(&bent, 0.05).unwrap();
        assert!((0.5..0.6).contains(&bent.tolerance.displacement.metres));
        assert!(Truth::of_places(&[exact[0]; 3], 0.05).is_none());
        assert!(Truth::of_places(&[], 0.05).is_none());
    }

    #[test]
    fn the_error_over_an_area_is_that_of_the_simulator() {
        let simulated = PairTruth {
            target_from_source: Se2::new(3.0, -2.0, 1.0),
            overlap: 0.5,
            residual: 0.03,
            shared_centre: Point2::new(7.0, 1.5),
            shared_radius: 4.2,
        };
        let truth = Truth::of_simulated(&simulated, 0.05, false);
        for found in [Se2::identity(), Se2::new(3.1, -2.2, 1.01), Se2::new(3.0, -2.0, -2.5)] {
            let error = truth.error(&found);
            assert_eq!(error.displacement, simulated.displacement(&found));
            assert_eq!(error.turn, simulated.turn(&found));
        }
    }
}
