//! What two maps or more say of a cell, and what it becomes.

use std::cmp::Ordering;

use ogm_core::{CellClass, ClassThresholds, Occupancy};

use crate::FusionRule;
use crate::evidence::{ByteOfLogOdds, LogOddsOfByte};

#[derive(Default)]
pub(crate) struct Counts {
    pub(crate) compared: usize,
    pub(crate) conflicts: usize,
}

/// What is known of a cell that more than one layer knows.
#[derive(Clone, Copy, Default)]
pub(crate) struct Overlap {
    log_odds: f64,
    known: bool,
    said: u8,
    lowest: u8,
    highest: u8,
    last: u8,
}

impl Overlap {
    fn is_conflict(&self) -> bool {
        self.said == SAID_OCCUPIED | SAID_FREE
    }
}

pub(crate) const SAID_OCCUPIED: u8 = 1;
pub(crate) const SAID_FREE: u8 = 2;

pub(crate) struct Tables {
    pub(crate) log_odds: LogOddsOfByte,
    pub(crate) rounding: ByteOfLogOdds,
    said: [u8; 256],
}

impl Tables {
    pub(crate) fn new(thresholds: &ClassThresholds) -> Self {
        let mut said = [0; 256];
        for (byte, said) in (0..=u8::MAX).zip(&mut said) {
            *said = match thresholds.classify(Occupancy::from_byte(byte)) {
                CellClass::Occupied => SAID_OCCUPIED,
                CellClass::Free => SAID_FREE,
                CellClass::Undecided | CellClass::Unknown => 0,
            };
        }
        Self { log_odds: LogOddsOfByte::new(), rounding: ByteOfLogOdds::new(), said }
    }

    /// [`SAID_OCCUPIED`], [`SAID_FREE`] or 0.
    pub(crate) fn class(&self, cell: Occupancy) -> u8 {
        self.said[usize::from(cell.byte())]
    }

    /// Takes in one layer's part of a row: the first known value of a cell goes to `cells`, all of
    /// them to `overlaps` once there are two.
    pub(crate) fn accumulate(
        &self,
        said: &[Occupancy],
        cells: &mut [Occupancy],
        overlaps: &mut [Overlap],
    ) {
        for ((&new, cell), overlap) in said.iter().zip(cells).zip(overlaps) {
            if !new.is_known() {
                continue;
            }
            if !cell.is_known() {
                *cell = new;
                continue;
            }
            if !overlap.known {
                *overlap = self.first(*cell);
            }
            self.add(overlap, new);
        }
    }

    /// Decides the cells of a row that were heard of twice, and forgets what was said.
    pub(crate) fn resolve(
        &self,
        rule: FusionRule,
        cells: &mut [Occupancy],
        conflicts: &mut [bool],
        overlaps: &mut [Overlap],
    ) -> Counts {
        let mut counts = Counts::default();
        for ((cell, overlap), conflict) in cells.iter_mut().zip(overlaps).zip(conflicts) {
            if overlap.known {
                *cell = self.verdict(rule, *cell, overlap);
                *conflict = overlap.is_conflict();
                counts.compared += 1;
                counts.conflicts += usize::from(*conflict);
                *overlap = Overlap::default();
            }
        }
        counts
    }

    fn first(&self, cell: Occupancy) -> Overlap {
        let byte = cell.byte();
        Overlap {
            log_odds: self.log_odds.of(cell),
            known: true,
            said: self.said[usize::from(byte)],
            lowest: byte,
            highest: byte,
            last: byte,
        }
    }

    fn add(&self, overlap: &mut Overlap, cell: Occupancy) {
        let byte = cell.byte();
        overlap.log_odds += self.log_odds.of(cell);
        overlap.said |= self.said[usize::from(byte)];
        overlap.lowest = overlap.lowest.min(byte);
        overlap.highest = overlap.highest.max(byte);
        overlap.last = byte;
    }

    fn verdict(&self, rule: FusionRule, first: Occupancy, overlap: &Overlap) -> Occupancy {
        match rule {
            FusionRule::LogOdds => self.rounding.round(overlap.log_odds),
            // Which walls are kept is a matter of their neighbourhood; alone, a wall is.
            FusionRule::KeepWalls | FusionRule::Occupied => Occupancy::from_byte(overlap.highest),
            FusionRule::MaxConfidence => {
                // Byte 127 is one half; as far above it as below is a tie, which is one half.
                let total = u16::from(overlap.highest) + u16::from(overlap.lowest);
                Occupancy::from_byte(match total.cmp(&254) {
                    Ordering::Greater => overlap.highest,
                    Ordering::Less => overlap.lowest,
                    Ordering::Equal => 127,
                })
            }
            FusionRule::First => first,
            FusionRule::Last => Occupancy::from_byte(overlap.last),
        }
    }
}

/// The verdict on every pair of bytes: two maps are the common case.
pub(crate) struct PairVerdicts(Vec<PairVerdict>);

#[derive(Clone, Copy)]
struct PairVerdict {
    cell: Occupancy,
    kind: PairKind,
}

#[derive(Clone, Copy, PartialEq)]
enum PairKind {
    NotCompared,
    Compared,
    Conflict,
}

impl PairVerdicts {
    pub(crate) fn new(tables: &Tables, rule: FusionRule) -> Self {
        let bytes = || (0..=u8::MAX).map(Occupancy::from_byte);
        let pairs = bytes().flat_map(|first| bytes().map(move |second| (first, second)));
        let verdict = |(first, second): (Occupancy, Occupancy)| {
            if !(first.is_known() && second.is_known()) {
                let cell = if first.is_known() { first } else { second };
                let kind = PairKind::NotCompared;
                return PairVerdict { cell, kind };
            }
            let mut overlap = tables.first(first);
            tables.add(&mut overlap, second);
            let kind = if overlap.is_conflict() { PairKind::Conflict } else { PairKind::Compared };
            let cell = tables.verdict(rule, first, &overlap);
            PairVerdict { cell, kind }
        };
        Self(pairs.map(verdict).collect())
    }

    pub(crate) fn apply(
        &self,
        said: &[Occupancy],
        cells: &mut [Occupancy],
        conflicts: &mut [bool],
    ) -> Counts {
        let mut counts = Counts::default();
        for ((&new, cell), conflict) in said.iter().zip(cells).zip(conflicts) {
            let pair = (usize::from(cell.byte()) << 8) | usize::from(new.byte());
            let verdict = self.0[pair];
            *cell = verdict.cell;
            counts.compared += usize::from(verdict.kind != PairKind::NotCompared);
            if verdict.kind == PairKind::Conflict {
                *conflict = true;
                counts.conflicts += 1;
            }
        }
        counts
    }
}
