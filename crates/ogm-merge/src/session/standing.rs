//! Who stands where in a session, and what a call changed about it.

use grid_match::{PreparedMap, match_prepared};
use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Progress, Se2, wrap_angle};

use super::MergeSession;
use super::change::{Because, Change, ChangeKind};
use super::group::{Group, Standing};
use super::params::RobotPrior;
use super::robot::{Placement, Robot, RobotState};
use super::settle::{Settled, Settling};
use crate::MergeError;

/// A pose that differs by more than this at the middle of a map is another answer, metres and
/// radians.
const APART: (f64, f64) = (0.75, 0.1);

impl MergeSession {
    pub(super) fn settling(&self) -> Settling<'_> {
        Settling {
            params: &self.params,
            robots: &self.robots,
            maps: &self.maps,
            prepared: &self.prepared,
            pairs: &self.pairs,
            groups: &self.groups,
        }
    }

    pub(super) fn keep(&mut self, settled: Settled) -> Option<Because> {
        self.pairs = settled.pairs;
        self.groups = settled.groups;
        settled.because
    }

    pub(super) fn add(&mut self, robot: Robot, map: OccupancyGrid, prepared: PreparedMap) {
        self.groups.push(Group::alone(self.robots.len(), Se2::identity()));
        self.robots.push(robot);
        self.maps.push(map);
        self.prepared.push(prepared);
    }

    /// What somebody asks for about a robot takes the place of what was asked for before.
    pub(super) fn ask(
        &mut self,
        robot: &str,
        prior: Option<RobotPrior>,
        separate: bool,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        let before = self.placed();
        let index = self.known_index(robot)?;
        let holds_frame = self.groups.first().is_some_and(|world| world.members[0].map == index);
        if holds_frame && !separate {
            if let Some(pinned) = prior.filter(RobotPrior::is_given) {
                let old_world_from_map = self.groups[0].members[0].group_from_map;
                let new_from_old = pinned.world_from_map * old_world_from_map.inverse();
                for member in &mut self.groups[0].members {
                    member.group_from_map = new_from_old * member.group_from_map;
                }
            }
        } else {
            self.take_out(index);
            self.groups.push(Group::alone(index, Se2::identity()));
        }
        self.robots[index].prior = prior;
        self.robots[index].is_separated = separate;
        self.pairs.forget(index);
        let settled = self.settling().settle(&[index], progress)?;
        let because = self.keep(settled).or(Some(Because::Asked));
        Ok(self.changes(&before, because, None))
    }

    /// Forgets what belongs to the frame that a robot left; its place is carried over if its `new`
    /// map shows the walls of the old one.
    pub(super) fn start_anew(
        &mut self,
        index: usize,
        new: &PreparedMap,
        progress: &dyn Progress,
    ) -> Result<(), MergeError> {
        let matching = &self.params.align.matching;
        let found = match_prepared(&self.prepared[index], new, matching, progress)?;
        self.pairs.forget(index);
        let prior = self.robots[index].prior.take();
        if let Some(old_from_new) = found.outcome.found() {
            self.robots[index].prior = prior.map(|prior| RobotPrior {
                world_from_map: prior.world_from_map * old_from_new,
                ..prior
            });
            let members = self.groups.iter_mut().flat_map(|group| &mut group.members);
            for member in members.filter(|member| member.map == index) {
                member.group_from_map = member.group_from_map * old_from_new;
            }
        } else {
            self.take_out(index);
            self.groups.push(Group::alone(index, Se2::identity()));
        }
        Ok(())
    }

    /// Takes a map out of its group; another then holds the frame if it did.
    pub(super) fn take_out(&mut self, index: usize) {
        for group in &mut self.groups {
            group.members.retain(|member| member.map != index);
            if let Some(first) = group.members.first_mut() {
                first.covariance = Some(nalgebra::Matrix3::zeros());
                first.probability = 1.0;
            }
        }
        self.groups.retain(|group| !group.members.is_empty());
    }

    /// Who has a place in the world.
    pub(super) fn placed(&self) -> Vec<(String, Standing)> {
        let world = self.groups.first().map(|world| &world.members[..]).unwrap_or_default();
        let name = |standing: &Standing| self.robots[standing.map].name.clone();
        world.iter().map(|standing| (name(standing), standing.clone())).collect()
    }

    /// What is not as it was `before`, robot by robot; `anew` started in another frame.
    pub(super) fn changes(
        &self,
        before: &[(String, Standing)],
        because: Option<Because>,
        anew: Option<&str>,
    ) -> Vec<Change> {
        let after = self.placed();
        let of = |placed: &[(String, Standing)], name: &str| {
            placed.iter().find(|(robot, _)| robot == name).map(|(_, standing)| standing.clone())
        };
        let mut changes = Vec::new();
        for robot in &self.robots {
            let name = robot.name.as_str();
            let is_anew = anew == Some(name);
            if is_anew {
                changes.push(Change { robot: name.to_owned(), kind: ChangeKind::NewFrame });
            }
            let kind = match (of(before, name), of(&after, name)) {
                (Some(old), None) => ChangeKind::Undone {
                    old_world_from_map: old.group_from_map,
                    because: if is_anew {
                        Because::NewFrame
                    } else {
                        because.unwrap_or(Because::Asked)
                    },
                },
                (Some(old), Some(new)) if !is_anew => {
                    let centre = self.prepared[new.map].centre();
                    if !is_apart(&old.group_from_map, &new.group_from_map, centre) {
                        continue;
                    }
                    ChangeKind::Moved {
                        old_world_from_map: old.group_from_map,
                        world_from_map: new.group_from_map,
                        probability: new.probability,
                    }
                }
                (_, Some(new)) => ChangeKind::Placed {
                    world_from_map: new.group_from_map,
                    probability: new.probability,
                },
                (None, None) => continue,
            };
            changes.push(Change { robot: name.to_owned(), kind });
        }
        changes
    }

    pub(super) fn state(&self, index: usize) -> RobotState {
        let name = |map: usize| self.robots[map].name.clone();
        let placement = self.groups.first().and_then(|world| world.of(index));
        let group = self.groups.iter().find(|group| group.of(index).is_some());
        let members = group.map(|group| &group.members[..]).unwrap_or_default();
        let others = members.iter().filter(|member| member.map != index);
        let pairs = self.pairs.found.iter().filter_map(|pair| {
            let other = match index {
                target if target == pair.target => pair.source,
                source if source == pair.source => pair.target,
                _ => return None,
            };
            Some((name(other), pair.proposals.first()?.pose.probability))
        });
        RobotState {
            name: name(index),
            placement: placement.map(|standing| Placement {
                world_from_map: standing.group_from_map,
                covariance: standing.covariance,
                probability: standing.probability,
            }),
            with: others.map(|member| name(member.map)).collect(),
            best_match: pairs.max_by(|a, b| a.1.total_cmp(&b.1)),
            is_separated: self.robots[index].is_separated,
        }
    }
}

fn is_apart(a_from_map: &Se2, b_from_map: &Se2, centre: Point2<f64>) -> bool {
    let turn = wrap_angle(a_from_map.theta() - b_from_map.theta()).abs();
    turn > APART.1 || (*a_from_map * centre - *b_from_map * centre).norm() > APART.0
}
