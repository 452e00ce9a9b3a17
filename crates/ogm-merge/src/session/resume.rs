//! Writes a session down, and takes it up again.

use ogm_core::Progress;

use super::MergeSession;
use super::group::Group;
use super::pairs::Pairs;
use super::params::SessionParams;
use super::resume_error::{ResumeError, VERSION};
use super::saved::{SavedPair, SavedRobot, SavedSession, SavedStanding};
use crate::MergeError;
use crate::robot_map::RobotMap;
use crate::team::prepared;

impl MergeSession {
    /// All that the session knows, but its parameters.
    #[must_use]
    pub fn save(&self) -> SavedSession {
        let robots = self.robots.iter().zip(&self.maps);
        let pairs = self.pairs.found.iter().zip(&self.pairs.at);
        let standings = |group: &Group| group.members.iter().map(SavedStanding::new).collect();
        SavedSession {
            version: VERSION,
            robots: robots.map(|(robot, map)| SavedRobot::new(robot, map)).collect(),
            pairs: pairs.map(|(pair, at)| SavedPair::new(pair, at)).collect(),
            groups: self.groups.iter().map(standings).collect(),
        }
    }

    /// Goes on where a session was saved: what it is fed next gives what it would have given.
    ///
    /// # Errors
    /// Saved data that is no session, parameters outside their range, or a call that was cancelled.
    pub fn resume(
        saved: SavedSession,
        params: SessionParams,
        progress: &dyn Progress,
    ) -> Result<Self, MergeError> {
        saved.check()?;
        let mut session = Self::new(params)?;
        for robot in saved.robots {
            let (robot, map) = robot.resumed()?;
            session.robots.push(robot);
            session.maps.push(map);
        }
        let maps: Vec<RobotMap<'_>> = session.maps.iter().map(RobotMap::from).collect();
        let thresholds = &session.params.align.matching.thresholds;
        session.prepared = prepared(&maps, thresholds, progress)?;
        session.pairs = Pairs::default();
        for (pair, at) in saved.pairs.iter().map(SavedPair::resumed) {
            session.pairs.put(pair, at);
        }
        let group = |members: &Vec<SavedStanding>| Group {
            members: members.iter().map(SavedStanding::resumed).collect(),
        };
        session.groups = saved.groups.iter().map(group).collect();
        Ok(session)
    }
}

impl SavedSession {
    fn check(&self) -> Result<(), ResumeError> {
        if self.version != VERSION {
            return Err(ResumeError::Version { found: self.version });
        }
        let count = self.robots.len();
        let is_pair = |pair: &SavedPair| pair.target < pair.source && pair.source < count;
        if !self.pairs.iter().all(is_pair) {
            return Err(ResumeError::Inconsistent("a pair of no two of its maps"));
        }
        if self.groups.iter().any(Vec::is_empty) {
            return Err(ResumeError::Inconsistent("a group of no map"));
        }
        let mut standing: Vec<usize> = self.groups.iter().flatten().map(|one| one.map).collect();
        standing.sort_unstable();
        if standing != (0..count).collect::<Vec<_>>() {
            return Err(ResumeError::Inconsistent("maps that do not stand exactly once"));
        }
        if !self.groups.iter().flatten().all(SavedStanding::is_finite) {
            return Err(ResumeError::Inconsistent("a pose that is not finite"));
        }
        Ok(())
    }
}
