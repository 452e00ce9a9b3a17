//! What the live merging can be told beforehand.

use std::collections::BTreeMap;

use ogm_merge::{FusionParams, RobotPrior, SessionParams};

/// Probability that a join must reach. A team is decided about anew whenever maps have grown, so
/// that the most misleading of many moments counts, and others drive by what is published; two
/// maps on disk are decided about once. Of some hundred joins, one that is as sure as 0.99 is wrong
/// for a while.
const ACCEPT: f64 = 0.999;

/// How the maps of a running team are merged.
#[derive(Debug, Clone)]
pub struct LiveParams {
    /// The frame of the merged map: `world`.
    pub world_frame: String,
    /// How maps are matched and placed; a join must reach a probability of 0.999.
    pub session: SessionParams,
    /// How they become one.
    pub fusion: FusionParams,
    /// What is known about where robots' maps lie, before the first of them arrives.
    pub priors: BTreeMap<String, RobotPrior>,
    /// What a robot may send.
    pub limits: Limits,
}

impl Default for LiveParams {
    fn default() -> Self {
        let mut session = SessionParams::default();
        session.align.matching.accept = ACCEPT;
        Self {
            world_frame: "world".to_owned(),
            session,
            fusion: FusionParams::default(),
            priors: BTreeMap::new(),
            limits: Limits::default(),
        }
    }
}

/// What a robot may send: whoever can write to the network can say anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Robots that are listened to: 16.
    pub robots: usize,
    /// Cells of a map: 36 million, 300 m a side at 0.05 m.
    pub cells: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { robots: 16, cells: 36_000_000 }
    }
}
