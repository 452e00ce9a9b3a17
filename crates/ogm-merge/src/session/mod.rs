//! A team whose maps grow: what was found stays until something better is.

mod arrange;
mod change;
mod group;
mod pairs;
mod params;
mod resume;
mod resume_error;
mod robot;
mod saved;
mod settle;
mod standing;

use grid_match::PreparedMap;
use grid_merge::Merged;
use ogm_core::{OccupancyGrid, Progress, Stage};

use self::group::Group;
use self::pairs::Pairs;
use self::robot::{Robot, changed_share, is_same_frame};
use crate::{Component, FusionParams, Member, MergeError, fuse};

pub use self::change::{Because, Change, ChangeKind};
pub use self::params::{RobotPrior, SessionParams};
pub use self::resume_error::ResumeError;
pub use self::robot::{Placement, RobotState};
pub use self::saved::SavedSession;

/// The maps of a running team, and what is known about where they lie in one world.
///
/// The world is the frame of the first robot's map, or that in which its pose was given, and never
/// moves. Every call does only what it asks for: a map that grew is matched again where it changed
/// enough ([`SessionParams::changed_share`]), and what stands is kept unless walls contradict it or
/// another arrangement is better by [`SessionParams::lead`]. So answers of equal evidence do not
/// take turns. [`reconsider`](Self::reconsider) forgets what stands and asks what
/// [`merge_team`](crate::merge_team) would.
///
/// The same calls in the same order give the same answer, with any number of threads. What is held
/// is a map, what is computed of it and at most five poses a pair, whatever the number of calls.
/// A call that was cancelled leaves maps where they stood, and the next takes up what was left.
///
/// ```
/// use ogm_merge::{FusionParams, MergeSession, SessionParams};
/// use ogm_sim::{FloorPlan, LidarParams, MappingParams, PairParams, simulate_pair};
///
/// let sparse = LidarParams { beams: 181, ..LidarParams::rf() };
/// let mapping = MappingParams { resolution: 0.05, ..MappingParams::default() };
/// let world = PairParams { seed: 1, lidar: sparse, mapping, ..PairParams::default() };
/// let pair = simulate_pair(&FloorPlan::plan_a(), &world)?;
///
/// let mut session = MergeSession::new(SessionParams::default())?;
/// session.update("red", &pair.target.map, &())?;
/// session.update("blue", &pair.source.map, &())?;
/// let blue = session.robot("blue").and_then(|robot| robot.placement).expect("one floor");
/// let error = blue.world_from_map.between(&pair.target_from_source);
/// assert!(error.translation().norm() < 0.02);
/// assert!(session.fuse(&FusionParams::default(), &())?.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MergeSession {
    params: SessionParams,
    /// In the order in which they came; so are `maps` and `prepared`.
    robots: Vec<Robot>,
    maps: Vec<OccupancyGrid>,
    prepared: Vec<PreparedMap>,
    pairs: Pairs,
    /// Every map is in one; the first is the world, and its first map holds the frame.
    groups: Vec<Group>,
}

impl MergeSession {
    /// A session without robots.
    ///
    /// # Errors
    /// Parameters outside their range.
    pub fn new(params: SessionParams) -> Result<Self, MergeError> {
        params.check()?;
        Ok(Self {
            params,
            robots: Vec::new(),
            maps: Vec::new(),
            prepared: Vec::new(),
            pairs: Pairs::default(),
            groups: Vec::new(),
        })
    }

    /// Takes the map that a robot has by now, in the frame of its earlier ones, and says what this
    /// changes. A robot that was not heard of before joins.
    ///
    /// # Errors
    /// A map that cannot be matched, or a call that was cancelled.
    pub fn update(
        &mut self,
        robot: &str,
        map: &OccupancyGrid,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        let before = self.placed();
        let known = self.index(robot);
        if known.is_some_and(|index| self.maps[index] == *map) {
            progress.report(1.0);
            return Ok(Vec::new());
        }
        let thresholds = &self.params.align.matching.thresholds;
        let prepared = PreparedMap::new(map, thresholds, &Stage::new(progress, 0.0, 0.1))?;
        let mut anew = None;
        let index = match known {
            None => {
                self.add(Robot::new(robot), map.clone(), prepared);
                self.robots.len() - 1
            }
            Some(index) => {
                let is_continued = is_same_frame(&self.prepared[index], &prepared)?;
                let changed = changed_share(&self.maps[index], map, thresholds);
                if !is_continued {
                    self.start_anew(index, &prepared, &Stage::new(progress, 0.1, 0.2))?;
                    anew = Some(robot);
                }
                self.maps[index] = map.clone();
                self.prepared[index] = prepared;
                let at = &mut self.robots[index].at;
                at.revision += 1;
                at.changed += changed;
                index
            }
        };
        let settled = self.settling().settle(&[index], &Stage::new(progress, 0.2, 1.0))?;
        let because = self.keep(settled);
        Ok(self.changes(&before, because, anew))
    }

    /// Takes in what somebody knows about where a robot's map lies, in place of what was known
    /// before, and undoes [`separate`](Self::separate). The pose of the map that holds the frame
    /// moves the whole world if it is pinned elsewhere.
    ///
    /// # Errors
    /// A robot that nobody heard of, a pose that is not finite, or a call that was cancelled.
    pub fn set_prior(
        &mut self,
        robot: &str,
        prior: RobotPrior,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        prior.check()?;
        self.ask(robot, Some(prior), false, progress)
    }

    /// Takes a robot's map out of what it hangs together with, and keeps it out.
    ///
    /// # Errors
    /// A robot that nobody heard of, or a call that was cancelled.
    pub fn separate(
        &mut self,
        robot: &str,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        let index = self.known_index(robot)?;
        self.ask(robot, self.robots[index].prior, true, progress)
    }

    /// Forgets what was said by [`set_prior`](Self::set_prior) and [`separate`](Self::separate):
    /// the robot's map is searched for anew.
    ///
    /// # Errors
    /// A robot that nobody heard of, or a call that was cancelled.
    pub fn release(
        &mut self,
        robot: &str,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        self.ask(robot, None, false, progress)
    }

    /// Forgets a robot; the places of the others stay. Whether there was one of that name.
    pub fn remove(&mut self, robot: &str) -> bool {
        let Some(index) = self.index(robot) else { return false };
        self.take_out(index);
        self.pairs.remove(index);
        self.robots.remove(index);
        self.maps.remove(index);
        self.prepared.remove(index);
        for member in self.groups.iter_mut().flat_map(|group| &mut group.members) {
            member.map -= usize::from(member.map > index);
        }
        true
    }

    /// Searches every pair again whose maps changed at all since, and arranges all maps from
    /// nothing, as [`merge_team`](crate::merge_team) does; what was asked for is kept.
    ///
    /// # Errors
    /// A call that was cancelled.
    pub fn reconsider(&mut self, progress: &dyn Progress) -> Result<Vec<Change>, MergeError> {
        let before = self.placed();
        let settled = self.settling().reconsider(progress)?;
        let because = self.keep(settled);
        Ok(self.changes(&before, because, None))
    }

    /// The robots, in the order in which they came.
    #[must_use]
    pub fn robots(&self) -> Vec<RobotState> {
        (0..self.robots.len()).map(|index| self.state(index)).collect()
    }

    /// One robot; `None` if nobody heard of it.
    #[must_use]
    pub fn robot(&self, name: &str) -> Option<RobotState> {
        self.index(name).map(|index| self.state(index))
    }

    /// The map that a robot sent last.
    #[must_use]
    pub fn map(&self, robot: &str) -> Option<&OccupancyGrid> {
        self.index(robot).map(|index| &self.maps[index])
    }

    /// All maps that have a place in the world as one, in its frame, at the resolution of the map
    /// that holds it unless `params` say otherwise; `None` without maps.
    ///
    /// # Errors
    /// Maps that cannot be fused, or a call that was cancelled.
    pub fn fuse(
        &self,
        params: &FusionParams,
        progress: &dyn Progress,
    ) -> Result<Option<Merged>, MergeError> {
        let Some(world) = self.groups.first() else { return Ok(None) };
        let members = world.members.iter().map(|standing| Member {
            map: standing.map,
            reference_from_map: standing.group_from_map,
            covariance: standing.covariance,
            bend_m: standing.bend_m,
        });
        let component = Component { members: members.collect() };
        let maps: Vec<&OccupancyGrid> = self.maps.iter().collect();
        fuse(&maps, &component, params, progress).map(Some)
    }

    fn index(&self, robot: &str) -> Option<usize> {
        self.robots.iter().position(|known| known.name == robot)
    }

    fn known_index(&self, robot: &str) -> Result<usize, MergeError> {
        self.index(robot).ok_or_else(|| MergeError::NoSuchRobot { name: robot.to_owned() })
    }
}
