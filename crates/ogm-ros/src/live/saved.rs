//! The live merging as plain data, to go on with after a restart.

use std::collections::BTreeMap;

use ogm_core::Progress;
use ogm_merge::{MergeSession, SavedSession};
use serde::{Deserialize, Serialize};

use super::intake::Intake;
use super::{Live, LiveError, LiveParams};

/// Everything that a [`Live`] knows, but its parameters and what waits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedLive {
    /// Where the maps lie.
    session: SavedSession,
    /// What the robots call their frames.
    frames: BTreeMap<String, String>,
}

impl Live {
    /// All that is known by now.
    #[must_use]
    pub fn save(&self) -> SavedLive {
        let frames = self.robots.iter().map(|(name, robot)| (name.clone(), robot.frame.clone()));
        SavedLive { session: self.session.save(), frames: frames.collect() }
    }

    /// Goes on where it was saved: the world is the same, and what was placed is.
    ///
    /// # Errors
    /// Saved data that is none, parameters outside their range, or a call that was cancelled.
    pub fn resume(
        saved: SavedLive,
        params: LiveParams,
        progress: &dyn Progress,
    ) -> Result<Self, LiveError> {
        let session = MergeSession::resume(saved.session, params.session.clone(), progress)?;
        let frames = saved.frames.into_iter();
        let robots = frames.map(|(name, frame)| (name, Intake::known(frame)));
        let mut live = Self { session, robots: robots.collect(), ..Self::new(params)? };
        // Priors that were used are part of the session.
        live.priors.retain(|name, _| live.session.robot(name).is_none());
        live.known.is_stale = true;
        Ok(live)
    }
}
