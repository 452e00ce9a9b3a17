//! What a prior pose leaves of the search.

use ogm_core::{Se2, wrap_angle};

use crate::mode::{MODE_M, MODE_RAD};
use crate::params::Prior;
use crate::prepare::PreparedMap;
use crate::rotation::SWEEP_STEP;

/// Standard deviations to which a prior is believed.
const SIGMAS: f64 = 3.0;

/// Most log-odds that a prior adds: twenty to one.
const MOST_CREDIT: f64 = 3.0;

/// Poses that a prior allows, in the local frames of the search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) first_from_second: Se2,
    target_from_source: Se2,
    target_from_first: Se2,
    second_from_source: Se2,
    swapped: bool,
    reach_m: f64,
    reach_rad: f64,
}

impl Bounds {
    /// `first` is the target unless `swapped`.
    pub(crate) fn new(
        prior: &Prior,
        first: &PreparedMap,
        second: &PreparedMap,
        swapped: bool,
    ) -> Self {
        let target_from_source = prior.target_from_source;
        let given_first_from_second =
            if swapped { target_from_source.inverse() } else { target_from_source };
        let first_from_map = first.map_from_local.inverse();
        Self {
            first_from_second: first_from_map * given_first_from_second * second.map_from_local,
            target_from_source,
            target_from_first: first.map_from_local,
            second_from_source: second.map_from_local.inverse(),
            swapped,
            reach_m: SIGMAS * prior.sigma_m,
            reach_rad: SIGMAS * prior.sigma_rad,
        }
    }

    /// Log-odds that a prior adds: it rules out places where the maps could fit by chance. Bounded,
    /// for a prior may be wrong.
    pub(crate) fn credit(&self, first: &PreparedMap, second: &PreparedMap) -> f64 {
        let places = (first.known_area() + second.known_area()) / MODE_M.powi(2);
        let turns = std::f64::consts::TAU / MODE_RAD;
        let allowed_places = std::f64::consts::PI * (self.reach_m / MODE_M).powi(2);
        let allowed_turns = 2.0 * self.reach_rad / MODE_RAD;
        let allowed = allowed_places.clamp(1.0, places.max(1.0)) * allowed_turns.clamp(1.0, turns);
        (places.max(1.0) * turns / allowed).ln().clamp(0.0, MOST_CREDIT)
    }

    /// Whether a pose lies within the bounds.
    pub(crate) fn contains(&self, first_from_second: &Se2) -> bool {
        self.within(first_from_second, 0.0, 0.0)
    }

    /// Whether the refinement of a candidate on cells of `cell` metres could end inside.
    pub(crate) fn near(&self, first_from_second: &Se2, cell: f64) -> bool {
        self.within(first_from_second, 2.5 * cell, SWEEP_STEP)
    }

    fn within(&self, first_from_second: &Se2, slack_m: f64, slack_rad: f64) -> bool {
        let found = self.target_from_first * *first_from_second * self.second_from_source;
        let found_target_from_source = if self.swapped { found.inverse() } else { found };
        let prior = &self.target_from_source;
        let shift = (found_target_from_source.translation() - prior.translation()).norm();
        let turn = wrap_angle(found_target_from_source.theta() - prior.theta()).abs();
        shift <= self.reach_m + slack_m && turn <= self.reach_rad + slack_rad
    }

    /// Whether a rotation is worth trying.
    pub(crate) fn allows_rotation(&self, theta: f64) -> bool {
        let turn = wrap_angle(theta - self.first_from_second.theta()).abs();
        turn <= self.reach_rad + 0.5 * SWEEP_STEP
    }

    /// Rotations that cover the bounds in steps of 3° out from the prior, as many as there are up
    /// to a fan of nine.
    pub(crate) fn rotations(&self) -> Vec<f64> {
        let prior = self.first_from_second.theta();
        let mut rotations = vec![prior];
        let mut offset = SWEEP_STEP;
        while offset < self.reach_rad + 0.5 * SWEEP_STEP && rotations.len() < 9 {
            rotations.extend([wrap_angle(prior + offset), wrap_angle(prior - offset)]);
            offset += SWEEP_STEP;
        }
        rotations
    }
}
