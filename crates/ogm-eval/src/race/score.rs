//! Whether an answer is right.

use ogm_core::wrap_angle;

use super::answer::Answer;
use super::pair::Truth;

/// How one answer stands against the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Score {
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

impl Score {
    /// The score of an answer, `None` for a crash, to a pair with this truth, `None` for one that
    /// must be refused.
    pub(super) fn of(answer: Option<&Answer>, truth: Option<&Truth>) -> Self {
        let Some(answer) = answer else {
            return Self::Crash;
        };
        match (answer.target_from_source, truth) {
            (None, None) => Self::Refused,
            (None, Some(_)) => Self::Missed,
            (Some(_), None) => Self::False,
            (Some(target_from_source), Some(truth)) => {
                let at = truth.source_centroid;
                let error_m = (target_from_source * at - truth.target_from_source * at).norm();
                let turn = target_from_source.theta() - truth.target_from_source.theta();
                let error = wrap_angle(turn).abs();
                let within = |metres: f64, radians: f64| error_m < metres && error < radians;
                if !within(truth.tolerance_m, truth.tolerance) {
                    let near = within(0.5, 2.0_f64.to_radians());
                    return if near { Self::Near } else { Self::Wrong };
                }
                let strict = within(truth.target_resolution, 0.5_f64.to_radians());
                if strict { Self::Strict } else { Self::Inside }
            }
        }
    }

    pub(super) fn is_success(self) -> bool {
        matches!(self, Self::Strict | Self::Inside)
    }

    /// In a table; what counts against the command in capitals.
    pub(super) fn text(self) -> &'static str {
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
    use super::Score;
    use crate::race::answer::Answer;
    use crate::race::pair::Truth;
    use nalgebra::Point2;
    use ogm_core::Se2;

    /// A quarter turn, judged 10 m from the origin of the source.
    fn truth() -> Truth {
        Truth {
            target_from_source: Se2::new(3.0, -1.0, 90.0_f64.to_radians()),
            source_centroid: Point2::new(10.0, 0.0),
            target_resolution: 0.05,
            tolerance_m: 0.25,
            tolerance: 1.0_f64.to_radians(),
        }
    }

    /// The truth, then moved by `shift` metres and turned by `degrees` about the judged point.
    fn off_by(shift: f64, degrees: f64) -> Answer {
        let truth = truth();
        let at = truth.target_from_source * truth.source_centroid;
        let shift = nalgebra::Vector2::new(0.6 * shift, 0.8 * shift);
        let moved_from_target = Se2::about(at, degrees.to_radians(), shift);
        let target_from_source = Some(moved_from_target * truth.target_from_source);
        Answer { target_from_source, own_cpu_s: None }
    }

    #[test]
    fn each_limit_is_where_it_is_said_to_be() {
        for (shift, degrees, expected) in [
            (0.0, 0.0, Score::Strict),
            (0.049, 0.49, Score::Strict),
            (0.051, 0.0, Score::Inside),
            (0.0, -0.51, Score::Inside),
            (0.249, 0.99, Score::Inside),
            (0.251, 0.0, Score::Near),
            (0.0, 1.01, Score::Near),
            (0.499, -1.99, Score::Near),
            (0.501, 0.0, Score::Wrong),
            (0.0, 2.01, Score::Wrong),
            (0.0, 360.1, Score::Strict),
        ] {
            let score = Score::of(Some(&off_by(shift, degrees)), Some(&truth()));
            assert_eq!(score, expected, "{shift} m, {degrees} degrees");
        }
    }

    #[test]
    fn a_turn_about_the_origin_moves_the_judged_point() {
        let truth = truth();
        let turned = truth.target_from_source * Se2::new(0.0, 0.0, 0.9_f64.to_radians());
        let answer = Answer { target_from_source: Some(turned), own_cpu_s: None };
        let distance = 10.0 * 0.9_f64.to_radians();
        assert!(distance < 0.25, "inside");
        assert_eq!(Score::of(Some(&answer), Some(&truth)), Score::Inside);
        let far = Truth { source_centroid: Point2::new(20.0, 0.0), ..truth };
        assert_eq!(Score::of(Some(&answer), Some(&far)), Score::Near);
    }

    #[test]
    fn refusals_and_crashes_are_told_apart() {
        let refusal = Answer { target_from_source: None, own_cpu_s: None };
        assert_eq!(Score::of(Some(&refusal), Some(&truth())), Score::Missed);
        assert_eq!(Score::of(Some(&refusal), None), Score::Refused);
        assert_eq!(Score::of(Some(&off_by(0.0, 0.0)), None), Score::False);
        assert_eq!(Score::of(None, None), Score::Crash);
        assert_eq!(Score::of(None, Some(&truth())), Score::Crash);
    }
}
