//! Whether an answer is right.

use ogm_core::Se2;

use super::error::PoseError;
use super::tolerance::{NEAR, STRICT};
use super::truth::Truth;

/// How one answer stands against the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Within the pair's tolerance, one cell of the target and 0.5°.
    Strict,
    /// Within the pair's tolerance.
    Inside,
    /// Outside of it, but within 0.5 m and 2°.
    Near,
    /// Merged at another pose.
    Wrong,
    /// Refused though it matches.
    Missed,
    /// Refused as it must be.
    Refused,
    /// Merged though it must be refused.
    False,
    /// No answer.
    Crash,
}

impl Verdict {
    /// On an answer, `None` for a refusal, to a pair with this truth, `None` for one that must be
    /// refused.
    pub(crate) fn of(target_from_source: Option<&Se2>, truth: Option<&Truth>) -> Self {
        match (target_from_source, truth) {
            (None, None) => Self::Refused,
            (None, Some(_)) => Self::Missed,
            (Some(_), None) => Self::False,
            (Some(pose), Some(truth)) => Self::of_error(truth.error(pose), truth),
        }
    }

    /// On a pose whose error has been taken.
    pub(crate) fn of_error(error: PoseError, truth: &Truth) -> Self {
        match (truth.admits(error), STRICT.admits(error, truth.cell)) {
            (true, true) => Self::Strict,
            (true, false) => Self::Inside,
            (false, _) if NEAR.admits(error, truth.cell) => Self::Near,
            (false, _) => Self::Wrong,
        }
    }

    /// Merged, and as it should be.
    pub(crate) fn is_right(self) -> bool {
        matches!(self, Self::Strict | Self::Inside)
    }

    /// Merged at a pose that is not right.
    pub(crate) fn is_outside(self) -> bool {
        matches!(self, Self::Near | Self::Wrong)
    }

    /// In a table; what counts against the command in capitals.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::Inside => "inside",
            Self::Near => "near",
            Self::Wrong => "WRONG",
            Self::Missed => "missed",
            Self::Refused => "refused",
            Self::False => "FALSE",
            Self::Crash => "CRASH",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Truth, Verdict};
    use crate::judge::HALF_A_DOOR;
    use nalgebra::Point2;
    use ogm_core::Se2;

    /// A quarter turn, judged 10 m from the origin of the source.
    fn truth() -> Truth {
        Truth {
            target_from_source: Se2::new(3.0, -1.0, 90.0_f64.to_radians()),
            centre: Point2::new(10.0, 0.0),
            radius: 0.0,
            cell: 0.05,
            tolerance: HALF_A_DOOR,
            exact: true,
        }
    }

    /// The truth, then moved by `shift` metres and turned by `degrees` about the judged point.
    fn off_by(shift: f64, degrees: f64) -> Se2 {
        let truth = truth();
        let at = truth.target_from_source * truth.centre;
        let shift = nalgebra::Vector2::new(0.6 * shift, 0.8 * shift);
        let moved_from_target = Se2::about(at, degrees.to_radians(), shift);
        moved_from_target * truth.target_from_source
    }

    #[test]
    fn each_limit_is_where_it_is_said_to_be() {
        for (shift, degrees, expected) in [
            (0.0, 0.0, Verdict::Strict),
            (0.049, 0.49, Verdict::Strict),
            (0.051, 0.0, Verdict::Inside),
            (0.0, -0.51, Verdict::Inside),
            (0.249, 0.99, Verdict::Inside),
            (0.251, 0.0, Verdict::Near),
            (0.0, 1.01, Verdict::Near),
            (0.499, -1.99, Verdict::Near),
            (0.501, 0.0, Verdict::Wrong),
            (0.0, 2.01, Verdict::Wrong),
            (0.0, 360.1, Verdict::Strict),
        ] {
            let verdict = Verdict::of(Some(&off_by(shift, degrees)), Some(&truth()));
            assert_eq!(verdict, expected, "{shift} m, {degrees} degrees");
        }
    }

    #[test]
    fn a_turn_about_the_origin_moves_the_judged_point() {
        let truth = truth();
        let turned = truth.target_from_source * Se2::new(0.0, 0.0, 0.9_f64.to_radians());
        let distance = 10.0 * 0.9_f64.to_radians();
        assert!(distance < 0.25, "inside");
        assert_eq!(Verdict::of(Some(&turned), Some(&truth)), Verdict::Inside);
        let far = Truth { centre: Point2::new(20.0, 0.0), ..truth };
        assert_eq!(Verdict::of(Some(&turned), Some(&far)), Verdict::Near);
    }

    #[test]
    fn refusals_are_right_where_nothing_matches() {
        assert_eq!(Verdict::of(None, Some(&truth())), Verdict::Missed);
        assert_eq!(Verdict::of(None, None), Verdict::Refused);
        assert_eq!(Verdict::of(Some(&off_by(0.0, 0.0)), None), Verdict::False);
    }
}
