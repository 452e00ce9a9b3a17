//! What a sample says, and how surely.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Resamples behind a bootstrap interval: its ends then repeat to about 1 % of its width.
const RESAMPLES: usize = 10_000;

/// The seed of the intervals in [`Summary`], so that a report is the same bytes each time.
const SUMMARY_SEED: u64 = 0;

/// 97.5 % quantile of the standard normal distribution.
const Z_975: f64 = 1.959_963_984_540_054;

/// 97.5 % quantiles of Student's t for 1 to 30 degrees of freedom.
const T_975: [f64; 30] = [
    12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, 2.2010,
    2.1788, 2.1604, 2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687,
    2.0639, 2.0595, 2.0555, 2.0518, 2.0484, 2.0452, 2.0423,
];

/// A sample in nine numbers, in the unit of the sample.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Summary {
    /// Values.
    pub(crate) n: usize,
    /// Arithmetic mean.
    pub(crate) mean: f64,
    /// Sample standard deviation (n − 1); NaN for one value.
    pub(crate) sd: f64,
    /// Middle value.
    pub(crate) median: f64,
    /// Percentile-bootstrap 95 % interval of the mean.
    pub(crate) ci95: (f64, f64),
    /// Least value.
    pub(crate) min: f64,
    /// Greatest value.
    pub(crate) max: f64,
    /// Lower quartile.
    pub(crate) q25: f64,
    /// Upper quartile.
    pub(crate) q75: f64,
}

impl Summary {
    /// The summary of `values` in any order; `None` for no values or a NaN among them.
    pub(crate) fn of(values: &[f64]) -> Option<Self> {
        let sorted = sorted(values)?;
        Some(Self {
            n: sorted.len(),
            mean: mean(values)?,
            sd: standard_deviation(values).unwrap_or(f64::NAN),
            median: quantile_of_sorted(&sorted, 0.5),
            ci95: bootstrap_ci95(values, SUMMARY_SEED)?,
            min: quantile_of_sorted(&sorted, 0.0),
            max: quantile_of_sorted(&sorted, 1.0),
            q25: quantile_of_sorted(&sorted, 0.25),
            q75: quantile_of_sorted(&sorted, 0.75),
        })
    }
}

/// Arithmetic mean, or `None` of nothing.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Sample standard deviation (n − 1), or `None` below two values.
pub(crate) fn standard_deviation(values: &[f64]) -> Option<f64> {
    let mean = mean(values).filter(|_| values.len() > 1)?;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    Some((squares / (values.len() - 1) as f64).sqrt())
}

/// The middle value, or `None` of nothing or with a NaN.
pub(crate) fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// The `p` quantile of `values` in any order, or `None` of nothing or with a NaN.
pub(crate) fn quantile(values: &[f64], p: f64) -> Option<f64> {
    sorted(values).map(|sorted| quantile_of_sorted(&sorted, p))
}

/// Percentile-bootstrap 95 % interval of the mean: the same for the same values and seed.
/// `None` of nothing or with a NaN.
pub(crate) fn bootstrap_ci95(values: &[f64], seed: u64) -> Option<(f64, f64)> {
    bootstrap_ci95_of(values.len(), seed, |drawn| {
        drawn.iter().map(|&index| values[index]).sum::<f64>() / drawn.len() as f64
    })
}

/// The same of any statistic of `count` cases, which is given the places of those drawn.
pub(crate) fn bootstrap_ci95_of(
    count: usize,
    seed: u64,
    statistic: impl Fn(&[usize]) -> f64,
) -> Option<(f64, f64)> {
    if count == 0 {
        return None;
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = vec![0; count];
    let mut found: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            drawn.fill_with(|| rng.random_range(0..count));
            statistic(&drawn)
        })
        .collect();
    if found.iter().any(|value| value.is_nan()) {
        return None;
    }
    found.sort_by(f64::total_cmp);
    let end = |p| quantile_of_sorted(&found, p);
    Some((end(0.025), end(0.975)))
}

/// Half the width of Student's 95 % interval of the mean, or `None` below two values.
pub(crate) fn student_half_width(values: &[f64]) -> Option<f64> {
    let sd = standard_deviation(values)?;
    let n = values.len();
    Some(t_975(n - 1) * sd / (n as f64).sqrt())
}

/// Wilson's 95 % interval of the share `successes / trials`; all of [0, 1] for no trials.
pub(crate) fn wilson_ci95(successes: usize, trials: usize) -> (f64, f64) {
    if trials == 0 {
        return (0.0, 1.0);
    }
    let n = trials as f64;
    let share = successes as f64 / n;
    let z_sq_over_n = Z_975 * Z_975 / n;
    let centre = share + z_sq_over_n / 2.0;
    let half = (z_sq_over_n * (share * (1.0 - share) + z_sq_over_n / 4.0)).sqrt();
    let scale = 1.0 + z_sq_over_n;
    let clamp = |end: f64| (end / scale).clamp(0.0, 1.0);
    (clamp(centre - half), clamp(centre + half))
}

/// How many of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Share {
    pub(crate) hits: usize,
    pub(crate) of: usize,
}

impl Share {
    /// The values for which something holds.
    pub(crate) fn holding<T>(values: &[T], holds: impl Fn(&T) -> bool) -> Self {
        let hits = values.iter().filter(|value| holds(value)).count();
        Self { hits, of: values.len() }
    }

    /// From 0 to 1; NaN of nothing.
    pub(crate) fn fraction(self) -> f64 {
        self.hits as f64 / self.of as f64
    }

    /// Wilson's 95 % interval.
    pub(crate) fn ci95(self) -> (f64, f64) {
        wilson_ci95(self.hits, self.of)
    }
}

/// 97.5 % quantile of Student's t: tabulated to 30 degrees of freedom, then the expansion of
/// Abramowitz and Stegun 26.7.5, exact there to four decimals.
fn t_975(degrees_of_freedom: usize) -> f64 {
    if let Some(&quantile) = T_975.get(degrees_of_freedom - 1) {
        return quantile;
    }
    let (z, v) = (Z_975, degrees_of_freedom as f64);
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / v + second / v.powi(2) + third / v.powi(3)
}

fn sorted(values: &[f64]) -> Option<Vec<f64>> {
    if values.is_empty() || values.iter().any(|value| value.is_nan()) {
        return None;
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    Some(sorted)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "p is clamped, so the position lies inside the sample"
)]
fn quantile_of_sorted(sorted: &[f64], p: f64) -> f64 {
    let position = p.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    let below = position as usize;
    let above = (below + 1).min(sorted.len() - 1);
    let share = position - position.floor();
    if share == 0.0 {
        sorted[below]
    } else {
        sorted[below] + share * (sorted[above] - sorted[below])
    }
}

#[cfg(test)]
mod tests {
    use super::{
        Summary, Z_975, bootstrap_ci95, quantile_of_sorted, student_half_width, t_975, wilson_ci95,
    };

    fn close(a: f64, b: f64, tolerance: f64) -> bool {
        (a - b).abs() <= tolerance
    }

    #[test]
    fn a_small_sample_by_hand() {
        let summary = Summary::of(&[4.0, 1.0, 3.0, 2.0, 10.0]).unwrap();
        assert_eq!((summary.n, summary.mean, summary.median), (5, 4.0, 3.0));
        assert!(close(summary.sd, 12.5_f64.sqrt(), 1e-12));
        assert_eq!((summary.min, summary.max), (1.0, 10.0));
        assert_eq!((summary.q25, summary.q75), (2.0, 4.0));
        assert!(summary.ci95.0 < 4.0 && 4.0 < summary.ci95.1);
    }

    #[test]
    fn quantiles_interpolate_as_type_seven() {
        let values = [1.0, 2.0, 3.0, 4.0];
        for (p, expected) in [(0.0, 1.0), (0.25, 1.75), (0.5, 2.5), (0.9, 3.7), (1.0, 4.0)] {
            assert!(close(quantile_of_sorted(&values, p), expected, 1e-12), "{p}");
        }
    }

    #[test]
    fn nothing_and_nan_have_no_summary() {
        assert_eq!(Summary::of(&[]), None);
        assert_eq!(Summary::of(&[1.0, f64::NAN]), None);
        assert_eq!(student_half_width(&[1.0]), None);
        let one = Summary::of(&[2.0]).unwrap();
        assert!(one.sd.is_nan(), "one value has no spread");
        assert_eq!(one.ci95, (2.0, 2.0));
    }

    /// The bootstrap's standard error is the sample's with n in place of n − 1.
    #[test]
    fn bootstrap_agrees_with_the_normal_interval_and_repeats() {
        let values: Vec<f64> = (0..100).map(f64::from).collect();
        let (low, high) = bootstrap_ci95(&values, 7).unwrap();
        let half = Z_975 * (9999.0_f64 / 12.0 / 100.0).sqrt();
        assert!(close(low, 49.5 - half, 0.04 * half), "{low}");
        assert!(close(high, 49.5 + half, 0.04 * half), "{high}");
        assert_eq!(bootstrap_ci95(&values, 7), Some((low, high)));
        assert_ne!(bootstrap_ci95(&values, 8), Some((low, high)));
    }

    #[test]
    fn student_widths_match_the_tables() {
        let half = student_half_width(&[1.0, 3.0]).unwrap();
        assert!(close(half, 12.7062, 1e-9));
        for (degrees, quantile) in [(10, 2.2281), (31, 2.0395), (40, 2.0211), (100_000, 1.9600)] {
            assert!(close(t_975(degrees), quantile, 6e-5), "{degrees}");
        }
    }

    /// 81 of 263: Newcombe, *Two-sided confidence intervals for the single proportion*, Table I.
    #[test]
    fn wilson_intervals_match_newcombe() {
        for (successes, trials, low, high) in [(81, 263, 0.2553, 0.3662), (0, 20, 0.0, 0.1611)] {
            let interval = wilson_ci95(successes, trials);
            assert!(close(interval.0, low, 5e-5) && close(interval.1, high, 5e-5), "{interval:?}");
        }
        assert_eq!(wilson_ci95(0, 0), (0.0, 1.0));
    }
}
