//! Whether the readings of a tag are what its model says, at the place where it is believed to be.

use nalgebra::{Matrix3, Point2, Vector3};

use crate::{FilterParams, Likelihood};

/// Residuals beyond this many sigma are outliers to [`Likelihood::Truncated`].
pub(crate) const OUTLIER_SIGMA: f64 = 3.0;

/// More outliers than this share are no outliers: the model is wrong.
const MOST_OUTLIERS: f64 = 0.25;

/// Standard deviation of the bias that a reader may have, metres.
const BIAS_SIGMA: f64 = 0.1;

/// Biases of this standard deviation matter to nobody, metres: half a cell.
const NEGLIGIBLE: f64 = 0.01;

/// Odds of a reader without a bias, before its readings are seen.
const UNBIASED_ODDS: f64 = 9.0;

/// Odds of a tag without a bias of its own, such as one before metal has.
const TAG_ODDS: f64 = 49.0;

/// Gauss–Newton steps to the place that a bias would have given the tag; a few suffice so near.
const STEPS: usize = 5;

/// What the residuals say about the sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// Root mean square residual, sigma.
    pub(crate) misfit: f64,
    /// Variance of the residuals over that of the model where that is more than chance, else 1.
    pub(crate) scale_sq: f64,
    /// What the ranges say about a bias that they have in common.
    pub(crate) bias: Bias,
}

impl Fit {
    pub(crate) fn of(
        readings: &[(Point2<f64>, f64)],
        position: Point2<f64>,
        params: &FilterParams,
    ) -> Self {
        let sigma = params.range_sigma;
        let residual =
            |&(robot, range): &(Point2<f64>, f64)| ((position - robot).norm() - range) / sigma;
        let fitting: Vec<_> = match params.likelihood {
            Likelihood::Gaussian => readings.to_vec(),
            Likelihood::Truncated => {
                let is_inlier = |reading: &&_| residual(reading).abs() <= OUTLIER_SIGMA;
                readings.iter().filter(is_inlier).copied().collect()
            }
        };
        let outliers = 1.0 - fitting.len() as f64 / readings.len() as f64;
        let counted = if outliers > MOST_OUTLIERS { readings } else { &fitting[..] };
        let sum_sq: f64 = counted.iter().map(|reading| residual(reading).powi(2)).sum();
        let count = counted.len() as f64;
        // Two unknowns were fitted; three readings say nothing yet.
        let freedom = count - 2.0;
        let scale_sq = if freedom > 0.0 {
            // Two standard deviations of χ² are chance.
            (sum_sq / freedom - 2.0 * (2.0 / freedom).sqrt()).max(1.0)
        } else {
            1.0
        };
        Self {
            misfit: (sum_sq / count).sqrt(),
            scale_sq,
            bias: Bias::of(counted, position, sigma * scale_sq.sqrt()),
        }
    }
}

/// What ranges say about their common bias, as a Gaussian over it, whose place was fitted too.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Bias {
    /// Inverse of its variance, 1/m².
    information: f64,
    /// The bias times the information, 1/m.
    moment: f64,
}

impl Bias {
    /// From ranges with `sigma` of noise to a tag near `position`.
    fn of(readings: &[(Point2<f64>, f64)], position: Point2<f64>, sigma: f64) -> Self {
        let mut place = position;
        let mut bias = 0.0;
        let mut variance = BIAS_SIGMA * BIAS_SIGMA;
        for _ in 0..STEPS {
            let prior = (sigma / BIAS_SIGMA).powi(2);
            let mut information = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, prior));
            let mut pull = Vector3::new(0.0, 0.0, -prior * bias);
            for &(robot, range) in readings {
                let arm = place - robot;
                let distance = arm.norm();
                if distance > 0.0 {
                    let row = Vector3::new(arm.x / distance, arm.y / distance, 1.0);
                    information += row * row.transpose();
                    pull += row * (range - distance - bias);
                }
            }
            let Some(inverse) = information.try_inverse() else { break };
            let step = inverse * pull;
            // Where place and bias cannot be told apart, a step leads anywhere.
            let size = step.norm();
            let step = if size > 1.0 { step / size } else { step };
            place += step.xy();
            bias += step.z;
            variance = sigma * sigma * inverse[(2, 2)];
        }
        // Without the prior, which is to be counted once.
        let information = (1.0 / variance - 1.0 / (BIAS_SIGMA * BIAS_SIGMA)).max(0.0);
        Self { information, moment: bias / variance }
    }

    /// What the tags of one reader say together.
    pub(crate) fn pooled<'a>(tags: impl IntoIterator<Item = &'a Self>) -> Self {
        tags.into_iter().fold(Self::default(), |sum, tag| Self {
            information: sum.information + tag.information,
            moment: sum.moment + tag.moment,
        })
    }

    /// The probability of a reader without a bias to speak of, by what its ranges make of either.
    pub(crate) fn unbiased(&self) -> f64 {
        self.probability(UNBIASED_ODDS)
    }

    /// The same of one tag among others of the reader, over that before its ranges were read, at
    /// most 1: below 1 where they speak for a bias of its own.
    pub(crate) fn support(&self) -> f64 {
        (self.probability(TAG_ODDS) * (1.0 + TAG_ODDS) / TAG_ODDS).min(1.0)
    }

    fn probability(&self, prior_odds: f64) -> f64 {
        let odds = prior_odds * (self.evidence(NEGLIGIBLE) - self.evidence(BIAS_SIGMA)).exp();
        if odds.is_finite() { odds / (1.0 + odds) } else { 1.0 }
    }

    /// Logarithm of the density of the ranges where biases have this standard deviation, metres,
    /// less that where there are none.
    fn evidence(&self, sigma: f64) -> f64 {
        let growth = 1.0 + self.information * sigma * sigma;
        0.5 * (self.moment * self.moment * sigma * sigma / growth - growth.ln())
    }
}
