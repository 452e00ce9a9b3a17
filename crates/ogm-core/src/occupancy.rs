//! Occupancy: one byte a cell, and what it means.

use crate::GridError;

/// Log-odds are clamped to ± this, so that no evidence is ever beyond revision.
pub const LOG_ODDS_LIMIT: f64 = 8.0;

/// The probability that a cell is occupied, in steps of 1/254, or unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Occupancy(u8);

impl Occupancy {
    /// Never observed; not the same as a probability of one half.
    pub const UNKNOWN: Self = Self(255);
    /// What a trinary map file means by occupied: p = 0.90.
    pub const OCCUPIED: Self = Self(229);
    /// What a trinary map file means by free: p = 0.10.
    pub const FREE: Self = Self(25);

    /// The nearest storable probability; outside [0, 1] it saturates, NaN is unknown.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=254 before the cast"
    )]
    pub fn from_probability(p: f64) -> Self {
        if p.is_nan() { Self::UNKNOWN } else { Self((p.clamp(0.0, 1.0) * 254.0).round() as u8) }
    }

    /// The nearest storable probability of a log-odds value, clamped to ±[`LOG_ODDS_LIMIT`].
    #[must_use]
    pub fn from_log_odds(l: f64) -> Self {
        Self::from_probability(probability_from_log_odds(l))
    }

    /// The stored byte: 255 is unknown, 0..=254 is p · 254.
    #[must_use]
    pub const fn byte(self) -> u8 {
        self.0
    }

    /// The cell of a stored byte.
    #[must_use]
    pub const fn from_byte(byte: u8) -> Self {
        Self(byte)
    }

    /// Probability of being occupied, or `None` if unknown.
    #[must_use]
    pub fn probability(self) -> Option<f64> {
        self.is_known().then(|| f64::from(self.0) / 254.0)
    }

    /// Log-odds of being occupied, clamped to ±[`LOG_ODDS_LIMIT`], or `None` if unknown.
    #[must_use]
    pub fn log_odds(self) -> Option<f64> {
        self.probability().map(log_odds)
    }

    /// Whether the cell was ever observed.
    #[must_use]
    pub const fn is_known(self) -> bool {
        self.0 != Self::UNKNOWN.0
    }
}

/// ln(p / (1 − p)), clamped to ±[`LOG_ODDS_LIMIT`].
#[must_use]
pub fn log_odds(p: f64) -> f64 {
    (p / (1.0 - p)).ln().clamp(-LOG_ODDS_LIMIT, LOG_ODDS_LIMIT)
}

/// 1 / (1 + exp(−l)) with `l` clamped to ±[`LOG_ODDS_LIMIT`].
#[must_use]
pub fn probability_from_log_odds(l: f64) -> f64 {
    1.0 / (1.0 + (-l.clamp(-LOG_ODDS_LIMIT, LOG_ODDS_LIMIT)).exp())
}

/// What a cell counts as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CellClass {
    /// Probably a wall.
    Occupied,
    /// Probably empty.
    Free,
    /// Observed, but neither.
    Undecided,
    /// Never observed.
    Unknown,
}

/// Where occupied begins and free ends; the default is p ≥ 0.65 and p ≤ 0.35, symmetric in
/// log-odds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClassThresholds {
    free: f64,
    occupied: f64,
    /// The same as bytes, so that classifying a grid compares integers.
    free_up_to: u8,
    occupied_from: u8,
}

impl ClassThresholds {
    /// Free at p ≤ `free`, occupied at p ≥ `occupied`.
    ///
    /// # Errors
    /// Unless 0 < `free` < 0.5 < `occupied` < 1.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "thresholds lie inside (0, 1)"
    )]
    pub fn new(free: f64, occupied: f64) -> Result<Self, GridError> {
        if 0.0 < free && free < 0.5 && 0.5 < occupied && occupied < 1.0 {
            let free_up_to = (free * 254.0).floor() as u8;
            let occupied_from = (occupied * 254.0).ceil() as u8;
            Ok(Self { free, occupied, free_up_to, occupied_from })
        } else {
            Err(GridError::InvalidThresholds { free, occupied })
        }
    }

    /// Highest probability that is free.
    #[must_use]
    pub fn free(&self) -> f64 {
        self.free
    }

    /// Lowest probability that is occupied.
    #[must_use]
    pub fn occupied(&self) -> f64 {
        self.occupied
    }

    /// The class of a cell.
    #[must_use]
    pub fn classify(&self, cell: Occupancy) -> CellClass {
        match cell {
            Occupancy::UNKNOWN => CellClass::Unknown,
            Occupancy(byte) if byte >= self.occupied_from => CellClass::Occupied,
            Occupancy(byte) if byte <= self.free_up_to => CellClass::Free,
            Occupancy(_) => CellClass::Undecided,
        }
    }

    /// Whether a cell is occupied.
    #[must_use]
    pub fn is_occupied(&self, cell: Occupancy) -> bool {
        cell.is_known() && cell.0 >= self.occupied_from
    }

    /// Whether a cell is free.
    #[must_use]
    pub fn is_free(&self, cell: Occupancy) -> bool {
        cell.0 <= self.free_up_to
    }
}

impl Default for ClassThresholds {
    fn default() -> Self {
        Self { free: 0.35, occupied: 0.65, free_up_to: 88, occupied_from: 166 }
    }
}

#[cfg(test)]
mod tests {
    use super::{CellClass, ClassThresholds, Occupancy, log_odds};
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn default_thresholds_are_the_validated_ones() {
        assert_eq!(ClassThresholds::default(), ClassThresholds::new(0.35, 0.65).unwrap());
        for (free, occupied) in [(0.0, 0.65), (0.35, 1.0), (0.5, 0.65), (f64::NAN, 0.65)] {
            assert!(ClassThresholds::new(free, occupied).is_err(), "{free} {occupied}");
        }
    }

    #[test]
    fn unknown_is_not_one_half() {
        let half = Occupancy::from_probability(0.5);
        let thresholds = ClassThresholds::default();
        assert_eq!(thresholds.classify(half), CellClass::Undecided);
        assert_eq!(thresholds.classify(Occupancy::UNKNOWN), CellClass::Unknown);
        assert_eq!(Occupancy::UNKNOWN.probability(), None);
        assert_eq!(Occupancy::from_probability(f64::NAN), Occupancy::UNKNOWN);
        assert_eq!(Occupancy::from_probability(1.0).byte(), 254, "certainly occupied is known");
    }

    #[test]
    fn trinary_constants_are_the_stated_probabilities() {
        assert_eq!(Occupancy::OCCUPIED, Occupancy::from_probability(0.90));
        assert_eq!(Occupancy::FREE, Occupancy::from_probability(0.10));
    }

    proptest! {
        #[test]
        fn storage_keeps_probability_to_half_a_step(p in 0.0_f64..=1.0) {
            let stored = Occupancy::from_probability(p).probability().unwrap();
            prop_assert!((stored - p).abs() <= 0.5 / 254.0 + 1e-12);
        }

        #[test]
        fn log_odds_round_trip(p in 0.001_f64..0.999) {
            let stored = Occupancy::from_log_odds(log_odds(p)).probability().unwrap();
            prop_assert!((stored - p).abs() <= 0.5 / 254.0 + 1e-9);
        }

        #[test]
        fn classes_follow_the_thresholds(p in 0.0_f64..=1.0) {
            let cell = Occupancy::from_probability(p);
            let stored = cell.probability().unwrap();
            let expected = if stored >= 0.65 {
                CellClass::Occupied
            } else if stored <= 0.35 {
                CellClass::Free
            } else {
                CellClass::Undecided
            };
            prop_assert!(ClassThresholds::default().classify(cell) == expected);
        }
    }
}
