//! Evidence as log-odds: summed without rounding, rounded to a byte once.

use ogm_core::{LOG_ODDS_LIMIT, Occupancy, log_odds};

/// Log-odds of every byte.
///
/// All are multiples of 2⁻³² and p and 1 − p are exact opposites, so sums carry no rounding error:
/// neither the order of the maps nor cancelling evidence can leave a trace of it.
pub(crate) struct LogOddsOfByte([f64; 256]);

impl LogOddsOfByte {
    pub(crate) fn new() -> Self {
        let scale = 4_294_967_296.0;
        let mut table = [0.0; 256];
        for byte in 0..127_u8 {
            let l = log_odds(f64::from(byte) / 254.0);
            let l = (l * scale).round() / scale;
            table[usize::from(byte)] = l;
            table[usize::from(254 - byte)] = -l;
        }
        Self(table)
    }

    /// 0 if the cell is unknown.
    pub(crate) fn of(&self, cell: Occupancy) -> f64 {
        self.0[usize::from(cell.byte())]
    }
}

/// Buckets in one unit of log-odds: narrower than any byte is wide (4/254 at p = ½).
const BUCKETS_A_UNIT: f64 = 128.0;

/// [`Occupancy::from_log_odds`] without an exponential: the byte at the start of a narrow bucket,
/// and where in it the next byte begins.
pub(crate) struct ByteOfLogOdds(Vec<Bucket>);

struct Bucket {
    next_from: f64,
    byte: u8,
}

impl ByteOfLogOdds {
    pub(crate) fn new() -> Self {
        let buckets = (0..=bucket(LOG_ODDS_LIMIT)).map(|index| {
            let start = index as f64 / BUCKETS_A_UNIT - LOG_ODDS_LIMIT;
            let byte = Occupancy::from_log_odds(start).byte();
            let p_next = (f64::from(byte) + 0.5) / 254.0;
            let next_from = if p_next < 1.0 { log_odds(p_next) } else { f64::INFINITY };
            Bucket { next_from, byte }
        });
        Self(buckets.collect())
    }

    /// The nearest storable probability; `l` is clamped.
    pub(crate) fn round(&self, l: f64) -> Occupancy {
        let l = l.clamp(-LOG_ODDS_LIMIT, LOG_ODDS_LIMIT);
        let Bucket { next_from, byte } = self.0[bucket(l)];
        Occupancy::from_byte(byte + u8::from(l >= next_from))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "l is clamped, so the bucket is in 0..=2048"
)]
fn bucket(l: f64) -> usize {
    ((l + LOG_ODDS_LIMIT) * BUCKETS_A_UNIT) as usize
}

/// What the source cells of a coarse cell say: of the occupied ones alone once there is one.
#[derive(Clone, Copy, Default)]
pub(crate) struct MeanLogOdds {
    log_odds: f64,
    count: u32,
    occupied: bool,
}

impl MeanLogOdds {
    pub(crate) fn add(&mut self, log_odds: f64, occupied: bool) {
        if occupied && !self.occupied {
            *self = Self { occupied, ..Self::default() };
        }
        if occupied == self.occupied {
            self.log_odds += log_odds;
            self.count += 1;
        }
    }

    pub(crate) fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.log_odds / f64::from(self.count))
    }
}

#[cfg(test)]
mod tests {
    use super::{ByteOfLogOdds, LogOddsOfByte};
    use ogm_core::{Occupancy, log_odds, probability_from_log_odds};
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn independent_evidence_reinforces_and_weakens_as_worked_out() {
        for (a, b, expected) in [(0.8, 0.7, 0.903_226), (0.8, 0.3, 0.631_579), (0.8, 0.2, 0.5)] {
            let fused = probability_from_log_odds(log_odds(a) + log_odds(b));
            assert!((fused - expected).abs() < 5e-7, "{a} and {b} gave {fused}");
        }
    }

    #[test]
    fn every_byte_survives_log_odds_and_opposites_cancel_exactly() {
        let (table, rounding) = (LogOddsOfByte::new(), ByteOfLogOdds::new());
        for byte in 0..=254 {
            let l = table.of(Occupancy::from_byte(byte));
            assert_eq!(rounding.round(l).byte(), byte);
            assert_eq!(l + table.of(Occupancy::from_byte(254 - byte)), 0.0);
            let exact = log_odds(f64::from(byte) / 254.0);
            assert!((l - exact).abs() < 1e-9, "{byte}: {l} for {exact}");
        }
    }

    proptest! {
        #[test]
        fn rounding_is_that_of_the_formula(l in -9.0_f64..9.0) {
            let rounded = ByteOfLogOdds::new().round(l);
            // The formula may fall on the other side where l is a boundary to 1e-12.
            let below = Occupancy::from_log_odds(l - 1e-12);
            let above = Occupancy::from_log_odds(l + 1e-12);
            prop_assert!(rounded == below || rounded == above, "{rounded:?} for {l}");
        }
    }
}
