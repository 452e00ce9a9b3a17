//! The paper's cells: integers whose sign is what they say and whose size is how surely.

use ogm_core::Occupancy;

/// Certainly free; minus this is certainly an obstacle.
const CERTAIN: i16 = 255;

/// Between two storable probabilities.
const STEP: f64 = 1.0 / 254.0;

/// The belief in a cell as Carpin and Birk store it (section 4): −255 obstacle to 255 free, 0
/// unknown.
///
/// A cell known to be as likely occupied as free is 0 as well: the paper has no other word for it.
#[must_use]
pub fn belief(cell: Occupancy) -> i16 {
    let signed = cell.probability().map_or(0.0, |p| -f64::from(CERTAIN) * (2.0 * p - 1.0));
    #[expect(clippy::cast_possible_truncation, reason = "within ±255")]
    let belief = signed.round() as i16;
    belief
}

/// The cell of a belief, the reverse of [`belief`]; beyond ±255 it saturates.
///
/// The faintest belief keeps its side of one half, although storage is coarser than beliefs.
#[must_use]
pub fn occupancy(belief: i16) -> Occupancy {
    let p = 0.5 - 0.5 * f64::from(belief) / f64::from(CERTAIN);
    match belief.signum() {
        0 => Occupancy::UNKNOWN,
        1 => Occupancy::from_probability(p.min(0.5 - STEP)),
        _ => Occupancy::from_probability(p.max(0.5 + STEP)),
    }
}

#[cfg(test)]
mod tests {
    use super::{belief, occupancy};
    use ogm_core::Occupancy;

    #[test]
    fn signs_and_ends_are_those_of_the_paper() {
        assert_eq!(belief(Occupancy::from_probability(1.0)), -255);
        assert_eq!(belief(Occupancy::from_probability(0.0)), 255);
        assert_eq!(belief(Occupancy::UNKNOWN), 0);
        assert_eq!(occupancy(i16::MIN), Occupancy::from_probability(1.0));
    }

    #[test]
    fn nothing_but_one_half_is_lost_on_the_way_there_and_back() {
        for cell in (0..=u8::MAX).map(Occupancy::from_byte) {
            let expected = if cell.probability() == Some(0.5) { Occupancy::UNKNOWN } else { cell };
            assert_eq!(occupancy(belief(cell)), expected, "{cell:?}");
        }
        for value in -255..=255 {
            assert_eq!(belief(occupancy(value)).signum(), value.signum(), "{value}");
        }
    }
}
