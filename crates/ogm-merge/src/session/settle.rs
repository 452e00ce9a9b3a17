//! One call: the pairs that it makes due, and what then hangs together.

use grid_match::PreparedMap;
use ogm_core::{OccupancyGrid, Progress, Se2, Stage};

use super::arrange::Arranging;
use super::change::Because;
use super::group::Group;
use super::pairs::{Pairs, Progressed};
use super::params::SessionParams;
use super::robot::Robot;
use crate::team::{KnownPose, given, matched};
use crate::{MergeError, RobotMap};

/// Share of a call after which the pairs are searched.
const SEARCHED: f64 = 0.8;

/// A session as a call finds it.
pub(crate) struct Settling<'a> {
    pub(crate) params: &'a SessionParams,
    pub(crate) robots: &'a [Robot],
    pub(crate) maps: &'a [OccupancyGrid],
    pub(crate) prepared: &'a [PreparedMap],
    pub(crate) pairs: &'a Pairs,
    pub(crate) groups: &'a [Group],
}

/// What a call found.
pub(crate) struct Settled {
    pub(crate) pairs: Pairs,
    pub(crate) groups: Vec<Group>,
    /// Why a map may have lost its place.
    pub(crate) because: Option<Because>,
}

impl Settling<'_> {
    /// Searches what is due and arranges the maps, what stands first; `touched` are maps that are
    /// not what they were.
    pub(crate) fn settle(
        &self,
        touched: &[usize],
        progress: &dyn Progress,
    ) -> Result<Settled, MergeError> {
        let (pairs, searched) = self.searched(progress, |pair, robot, then| {
            let changed = robot.at.changed - then.changed;
            robot.at.revision > then.revision
                && (changed >= self.params.changed_share || (changed > 0.0 && self.is_near(pair)))
        })?;
        let joining = Stage::new(progress, SEARCHED, 1.0);
        let apart = self.apart();
        let known = |map| self.known(map);
        let arranging = self.arranging(&pairs, &apart, &known, &searched);
        let contradictions = arranging.contradictions(self.groups, touched)?;
        let mut standing = None;
        let mut because = None;
        if !contradictions.is_empty() || arranging.is_doubted(self.groups, &searched, touched)? {
            let all = pairs.all();
            let anew = Arranging { open: &all, ..arranging }
                .arranged(&scattered(self.groups), &joining)?;
            let lead = arranging.evidence(&anew)? - arranging.evidence(self.groups)?;
            because = match contradictions.iter().find(|found| !arranging.keeps(&anew, found)) {
                Some(walls) => {
                    Some(Because::Contradicted { conflict_m: walls.conflict_m, hit_m: walls.hit_m })
                }
                // What contradicts one map and not the other, all together may not believe.
                None => (lead >= self.params.lead).then_some(Because::Outweighed { lead }),
            };
            standing = because.is_some().then_some(anew);
        }
        let groups = match standing {
            Some(anew) => anew,
            None => arranging.arranged(self.groups, &joining)?,
        };
        progress.report(1.0);
        Ok(Settled { pairs, groups, because })
    }

    /// As [`settle`](Self::settle) with nothing that stands.
    pub(crate) fn reconsider(&self, progress: &dyn Progress) -> Result<Settled, MergeError> {
        let is_new = |_, robot: &Robot, then: &Progressed| robot.at != *then;
        let (pairs, _) = self.searched(progress, is_new)?;
        let apart = self.apart();
        let known = |map| self.known(map);
        let all = pairs.all();
        let arranging = self.arranging(&pairs, &apart, &known, &all);
        let joining = Stage::new(progress, SEARCHED, 1.0);
        let groups = arranging.arranged(&scattered(self.groups), &joining)?;
        let lead = arranging.evidence(&groups)? - arranging.evidence(self.groups)?;
        progress.report(1.0);
        Ok(Settled { pairs, groups, because: Some(Because::Outweighed { lead }) })
    }

    /// All pairs, those searched again that `is_due` says so of for one of its robots or that were
    /// never searched, and which these are.
    fn searched(
        &self,
        progress: &dyn Progress,
        is_due: impl Fn((usize, usize), &Robot, &Progressed) -> bool,
    ) -> Result<(Pairs, Vec<(usize, usize)>), MergeError> {
        let known = |map: usize| self.known(map);
        let mut due = Vec::new();
        for source in 0..self.robots.len() {
            for target in 0..source {
                let both = [target, source].map(|map| &self.robots[map]);
                let is_open = !both.iter().any(|robot| robot.is_separated)
                    && given(known(target), known(source)).is_none();
                let is_due = self.pairs.searched(target, source).is_none_or(|then| {
                    both.iter()
                        .zip(&then)
                        .any(|(robot, then)| is_due((target, source), robot, then))
                });
                if is_open && is_due {
                    due.push((target, source));
                }
            }
        }
        let maps: Vec<RobotMap<'_>> = self.maps.iter().map(RobotMap::from).collect();
        let searching = Stage::new(progress, 0.0, SEARCHED);
        let align = &self.params.align;
        let found = matched(&maps, self.prepared, &due, align, &known, &searching)?;
        let mut pairs = self.pairs.clone();
        for (pair, _) in found {
            let at = [pair.target, pair.source].map(|map| self.robots[map].at);
            pairs.put(pair, at);
        }
        Ok((pairs, due))
    }

    /// Whether two maps that do not hang together had one pose that is likelier than not: little
    /// more may decide, and a robot that has seen its part would never bring much.
    fn is_near(&self, (target, source): (usize, usize)) -> bool {
        let is_likely = self.pairs.found(target, source).is_some_and(|pair| {
            pair.proposals.first().is_some_and(|best| best.pose.probability >= 0.5)
        });
        let hang_together =
            |group: &Group| group.of(target).is_some() && group.of(source).is_some();
        is_likely && !self.groups.iter().any(hang_together)
    }

    fn apart(&self) -> Vec<usize> {
        (0..self.robots.len()).filter(|&map| self.robots[map].is_separated).collect()
    }

    fn arranging<'a>(
        &'a self,
        pairs: &'a Pairs,
        apart: &'a [usize],
        known: &'a dyn Fn(usize) -> Option<KnownPose>,
        open: &'a [(usize, usize)],
    ) -> Arranging<'a> {
        Arranging {
            prepared: self.prepared,
            pairs: &pairs.found,
            align: &self.params.align,
            known,
            apart,
            open,
        }
    }

    /// What is known about where a map lies in the world: what was said about it, or that it holds
    /// the frame.
    fn known(&self, map: usize) -> Option<KnownPose> {
        if let Some(prior) = self.robots[map].prior {
            let (reference_from_map, sigma_m) = (prior.world_from_map, prior.sigma_m);
            return Some(KnownPose {
                map,
                reference_from_map,
                sigma_m,
                sigma_rad: prior.sigma_rad,
            });
        }
        let gauge = &self.groups.first()?.members[0];
        let reference_from_map = gauge.group_from_map;
        (gauge.map == map).then_some(KnownPose {
            map,
            reference_from_map,
            sigma_m: 0.0,
            sigma_rad: 0.0,
        })
    }
}

/// Every map by itself, the one that holds the frame first.
fn scattered(groups: &[Group]) -> Vec<Group> {
    let Some(gauge) = groups.first().map(|world| &world.members[0]) else { return Vec::new() };
    let others = groups.iter().flat_map(|group| &group.members);
    let others = others.map(|member| member.map).filter(|&map| map != gauge.map);
    let gauge = Group::alone(gauge.map, gauge.group_from_map);
    std::iter::once(gauge).chain(others.map(|map| Group::alone(map, Se2::identity()))).collect()
}
