//! Whether a probability means what it says: the reliability curve of X7.

use super::record::Judged;
use crate::draw::{Chart, Mark, Series, chart};
use crate::report::{Criterion, Figure, Image, Table};
use crate::stats::wilson_ci95;

/// Edges of the bins; narrow where a verdict is decided.
const EDGES: [f64; 11] = [0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.98, 0.99, 1.0];
/// How much a floor that repeats itself counts where all floors are taken together: as many pairs
/// of these are drawn as of other kinds, to measure them, but few buildings are like them.
const REPEATING: f64 = 1.0 / 16.0;
/// When a bin is judged, and by what.
struct Floors {
    /// Pairs from which on.
    enough: f64,
    /// How far it may be off where its interval misses the diagonal.
    off: f64,
}

const FULL: Floors = Floors { enough: 100.0, off: 0.05 };
/// Some twenty pairs a bin: their share scatters by a tenth, and the low bins are said too low.
const QUICK: Floors = Floors { enough: 20.0, off: 0.3 };

/// The best poses whose probability falls between two edges.
struct Bin {
    low: f64,
    high: f64,
    pairs: f64,
    right: f64,
    /// Mean of what was said.
    said: f64,
}

impl Bin {
    fn observed(&self) -> f64 {
        self.right / self.pairs
    }

    fn interval(&self) -> (f64, f64) {
        wilson_ci95(rounded(self.right), rounded(self.pairs))
    }

    fn holds(&self, off: f64) -> bool {
        let (low, high) = self.interval();
        (low..=high).contains(&self.said) || (self.observed() - self.said).abs() <= off
    }
}

/// Table, figure and criteria of the curve.
pub(super) fn curve(judged: &[Judged], quick: bool) -> (Table, Figure, Vec<Criterion>) {
    let sets = [
        ("all floors", bins(judged, |one| if one.kind.repeats() { REPEATING } else { 1.0 })),
        (
            "floors that do not repeat",
            bins(judged, |one| if one.kind.repeats() { 0.0 } else { 1.0 }),
        ),
        ("floors that repeat", bins(judged, |one| if one.kind.repeats() { 1.0 } else { 0.0 })),
    ];
    let table = Table {
        caption: "Probability of the best pose against how often it is right, 95 % intervals. \
                  Where \
                  all floors are taken together, a pair of a floor that repeats counts one \
                  sixteenth. Of floors that repeat, pairs of parts that do not overlap are left \
                  out."
            .to_owned(),
        header: ["pairs of", "probability", "pairs", "mean probability", "right"]
            .map(str::to_owned)
            .to_vec(),
        rows: sets.iter().flat_map(|(name, bins)| bins.iter().map(|bin| row(name, bin))).collect(),
    };
    let floors = if quick { QUICK } else { FULL };
    let criteria = sets[..2].iter().map(|(name, bins)| criterion(name, bins, &floors));
    (table, figure(&sets), criteria.collect())
}

/// `weight` says how many pairs a pair stands for.
fn bins(judged: &[Judged], weight: impl Fn(&Judged) -> f64) -> Vec<Bin> {
    let said: Vec<(f64, bool, f64)> = judged
        .iter()
        .filter(|one| one.is_decidable() && weight(one) > 0.0)
        .filter_map(|one| one.best.map(|best| (best.probability, best.is_right, weight(one))))
        .collect();
    EDGES
        .windows(2)
        .filter_map(|edges| {
            let [low, high] = [edges[0], edges[1]];
            let inside = |p: f64| p >= low && (p < high || high == 1.0);
            let inside: Vec<_> = said.iter().filter(|(p, _, _)| inside(*p)).collect();
            let pairs: f64 = inside.iter().map(|(_, _, weight)| weight).sum();
            (pairs > 0.0).then(|| Bin {
                low,
                high,
                pairs,
                right: inside
                    .iter()
                    .map(|(_, right, weight)| if *right { *weight } else { 0.0 })
                    .sum(),
                said: inside.iter().map(|(p, _, weight)| p * weight).sum::<f64>() / pairs,
            })
        })
        .collect()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a sum of weights, not below 0"
)]
fn rounded(weight: f64) -> usize {
    weight.round() as usize
}

fn row(name: &str, bin: &Bin) -> Vec<String> {
    let (low, high) = bin.interval();
    vec![
        name.to_owned(),
        format!("{:.2}–{:.2}", bin.low, bin.high),
        format!("{:.0}", bin.pairs),
        format!("{:.3}", bin.said),
        format!("{:.3} [{low:.3}, {high:.3}]", bin.observed()),
    ]
}

fn figure(sets: &[(&str, Vec<Bin>); 3]) -> Figure {
    let mut series = vec![Series {
        name: "as it should be".to_owned(),
        points: vec![(0.0, 0.0), (1.0, 1.0)],
        mark: Mark::Dashed,
    }];
    series.extend(sets.iter().map(|(name, bins)| Series {
        name: (*name).to_owned(),
        points: bins.iter().map(|bin| (bin.said, bin.observed())).collect(),
        mark: Mark::DottedLine,
    }));
    Figure {
        name: "reliability".to_owned(),
        caption: "How often the best pose is right, by the probability that it was given."
            .to_owned(),
        image: Image::Svg(chart(&Chart {
            title: "Reliability of the probability".to_owned(),
            x_label: "probability given".to_owned(),
            y_label: "share right".to_owned(),
            log_y: false,
            series,
        })),
    }
}

fn criterion(name: &str, bins: &[Bin], floors: &Floors) -> Criterion {
    let Floors { enough, off } = *floors;
    let judged = || bins.iter().filter(|bin| bin.pairs >= enough);
    let gap = judged().map(|bin| (bin.observed() - bin.said).abs()).fold(0.0, f64::max);
    Criterion {
        id: format!("X7 reliability, {name}"),
        statement: format!(
            "every bin of ≥ {enough} pairs holds the diagonal or is within {off}; largest gap"
        ),
        paper: None,
        ours: gap,
        interval: None,
        pass: judged().next().is_some() && judged().all(|bin| bin.holds(off)),
    }
}
