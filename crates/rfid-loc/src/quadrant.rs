//! Which of four quarter turns aligns two rectangular buildings (Eq. 7).

use std::f64::consts::{FRAC_PI_2, TAU};

use ogm_core::{GridError, wrap_angle, wrap_period};

use crate::TagError;

/// Residuals above this, radians (20°), deserve a warning.
const WARNING_ABOVE: f64 = 20.0 * TAU / 360.0;

/// Residuals above this, radians (35°), leave two quarter turns nearly as likely.
pub const AMBIGUOUS_ABOVE: f64 = 35.0 * TAU / 360.0;

/// The rotation between two maps: precise from the walls, its quarter turn from the tags.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadrant {
    /// Quarter turns that were added to the walls' rotation as given, 0 to 3.
    pub kappa: u8,
    /// Rotation of target-from-source in [−π, π), radians.
    pub theta: f64,
    /// What the tags' rotation has left over, at most π/4 in size, radians.
    pub residual: f64,
    /// How far the residual is from the next quarter turn.
    pub confidence: QuadrantConfidence,
}

/// How sure a quarter turn is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadrantConfidence {
    /// Tags and walls agree within 20°.
    Clear,
    /// They differ by 20° to 35°.
    Warning,
    /// They differ by more than 35°: the next quarter turn is less than 20° further off.
    Ambiguous,
}

/// The quarter turn of the walls' rotation that the tags support (Tsardoulias et al., Eq. 7).
///
/// `tag_rotation` is θ̂₃ and `wall_rotation` the target's wall direction less the source's, known
/// modulo a quarter turn; any representative gives the same `theta`. As printed, κ depends on θ̂₃
/// alone, its limits 215° and 305° leave a gap, and nothing is wrapped; here κ is the quarter turn
/// with the least residual.
///
/// # Errors
/// An angle that is not finite.
pub fn quadrant(tag_rotation: f64, wall_rotation: f64) -> Result<Quadrant, TagError> {
    check_angle(tag_rotation)?;
    check_angle(wall_rotation)?;
    // Whole turns are taken off first: quarter turns of a huge angle would not fit a float.
    let turns = (wrap_angle(tag_rotation) - wrap_angle(wall_rotation)) / FRAC_PI_2;
    let kappa = quarter_turns((turns + 0.5).floor());
    let theta = wrap_angle(wrap_angle(wall_rotation) + f64::from(kappa) * FRAC_PI_2);
    let residual = wrap_period(wrap_angle(tag_rotation) - theta, TAU);
    let confidence = match residual.abs() {
        size if size <= WARNING_ABOVE => QuadrantConfidence::Clear,
        size if size <= AMBIGUOUS_ABOVE => QuadrantConfidence::Warning,
        _ => QuadrantConfidence::Ambiguous,
    };
    Ok(Quadrant { kappa, theta, residual, confidence })
}

pub(crate) fn check_angle(theta: f64) -> Result<(), TagError> {
    if theta.is_finite() {
        Ok(())
    } else {
        let (x, y) = (0.0, 0.0);
        Err(GridError::NonFiniteTransform { x, y, theta }.into())
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number in 0..4"
)]
fn quarter_turns(turns: f64) -> u8 {
    turns.rem_euclid(4.0) as u8
}

#[cfg(test)]
mod tests {
    use super::{QuadrantConfidence, quadrant};
    use crate::TagError;
    use ogm_core::{GridError, wrap_angle, wrap_period};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

    /// Eq. 7 as printed, degrees; `None` where no case applies.
    fn printed_kappa(tags: f64) -> Option<u8> {
        [(-45.0, 45.0), (45.0, 135.0), (135.0, 215.0), (215.0, 305.0)]
            .iter()
            .zip(0..)
            .find_map(|(&(from, to), kappa)| (tags > from && tags < to).then_some(kappa))
    }

    #[test]
    fn t_q2_the_residual_form_finds_the_turn_where_the_printed_one_does_not() {
        // True rotation, walls, κ, κ as printed; degrees.
        for (tags, walls, kappa, printed) in [
            (220.0_f64, 40.0_f64, 2, Some(3)),
            (310.0, -50.0, 0, None),
            (312.0, 42.0, 3, None),
            (50.0, 50.0, 0, Some(1)),
            (140.0, 50.0, 1, Some(2)),
            (-60.0, 30.0, 3, None),
        ] {
            let found = quadrant(tags.to_radians(), walls.to_radians()).unwrap();
            assert_eq!(found.kappa, kappa, "({tags}, {walls})");
            assert!(wrap_angle(found.theta - tags.to_radians()).abs() < 1e-12);
            assert_eq!(printed_kappa(tags), printed, "({tags}, {walls})");
        }
    }

    #[test]
    fn confidence_falls_with_the_residual() {
        for (degrees, confidence) in [
            (19.9_f64, QuadrantConfidence::Clear),
            (-20.1, QuadrantConfidence::Warning),
            (34.9, QuadrantConfidence::Warning),
            (35.1, QuadrantConfidence::Ambiguous),
            (-44.9, QuadrantConfidence::Ambiguous),
        ] {
            let found = quadrant(1.0 + degrees.to_radians(), 1.0).unwrap();
            assert_eq!(found.confidence, confidence, "{degrees}");
            assert!((found.residual.to_degrees() - degrees).abs() < 1e-9);
        }
    }

    #[test]
    fn wrong_turns_are_as_rare_as_the_noise_allows() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let (mut wrong, mut undefined) = (0, 0);
        let runs = 20_000;
        for _ in 0..runs {
            let truth: f64 = random.random_range(-PI..PI);
            let walls = wrap_period(truth, FRAC_PI_2);
            // The difference of two directions, each in half a turn either way.
            let heading: f64 = random.random_range(-PI..PI);
            let tags = wrap_angle(heading + truth) - wrap_angle(heading);
            let noise: f64 = random.random_range(-1.0..1.0) * 40_f64.to_radians();
            let found = quadrant(tags + noise, walls).unwrap();
            wrong += u32::from(wrap_angle(found.theta - truth).abs() > 1e-9);
            undefined += u32::from(printed_kappa(tags.to_degrees()).is_none());
        }
        assert_eq!(wrong, 0, "noise below 45° never turns a map");
        let share = f64::from(undefined) / f64::from(runs);
        assert!((share - 0.40).abs() < 0.02, "printed cases cover too little: {share}");
    }

    #[test]
    fn angles_that_are_not_finite_are_errors() {
        for (tags, walls) in [(f64::NAN, 0.0), (0.0, f64::INFINITY)] {
            let error = quadrant(tags, walls).unwrap_err();
            let TagError::Grid(GridError::NonFiniteTransform { theta, .. }) = error else {
                panic!("{error}");
            };
            assert!(!theta.is_finite());
        }
    }

    proptest! {
        #[test]
        fn every_representative_of_the_walls_gives_one_rotation(
            tags in -7.0_f64..7.0, walls in -7.0_f64..7.0, quarters in -6_i32..6, turns in -3_i32..3,
        ) {
            let plain = quadrant(tags, walls).unwrap();
            prop_assert!(plain.residual.abs() <= FRAC_PI_4 + 1e-9);
            prop_assert!(plain.kappa < 4);
            let other = quadrant(
                tags + f64::from(turns) * TAU,
                walls + f64::from(quarters) * FRAC_PI_2,
            ).unwrap();
            if plain.residual.abs() < FRAC_PI_4 - 1e-9 {
                prop_assert!(wrap_angle(other.theta - plain.theta).abs() < 1e-9);
                let expected = (i32::from(plain.kappa) - quarters).rem_euclid(4);
                prop_assert_eq!(i32::from(other.kappa), expected);
            }
        }
    }
}
