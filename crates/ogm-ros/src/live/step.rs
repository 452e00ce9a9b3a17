//! One turn of the live merging.

use std::collections::BTreeMap;

use ogm_core::{Occupancy, OccupancyGrid, Progress};
use ogm_io::ros::{Header, OccupancyGridMessage, Time, to_cdr};
use ogm_merge::{Change, ChangeKind, MergeError, Merged, RobotPrior};
use serde::Serialize;

use super::command::Command;
use super::error::LiveError;
use super::names::map_frame;
use super::output::{Message, Output};
use super::placed::{PlacedFrame, transforms};
use super::{Live, status};
use crate::message::DiagnosticArray;

/// How often the status is published where nothing happens.
const STATUS_EVERY_NS: u64 = 1_000_000_000;

/// What a turn came to.
#[derive(Debug, Default)]
pub struct Step {
    /// What is to be published, in this order.
    pub messages: Vec<Message>,
    /// What happened, a line each.
    pub news: Vec<String>,
}

impl Live {
    /// Does what was ordered, takes up the map of the robot whose turn it is, and says what is to be
    /// published at `now`.
    ///
    /// # Errors
    /// A call that was cancelled. What a robot sends never is an error: it is refused, and the
    /// status says why.
    pub fn step(&mut self, now: Time, progress: &dyn Progress) -> Result<Step, LiveError> {
        let mut step = Step::default();
        for command in std::mem::take(&mut self.commands) {
            self.answer.clear();
            self.known.status = None;
            let outcome = self.obey(&command, progress);
            self.note(&mut step, &format!("{command:?}"), outcome)?;
        }
        if let Some((robot, map)) = self.next_map(&mut step)
            && self.session.map(&robot) != Some(&map)
        {
            let outcome = self.session.update(&robot, &map, progress);
            if let Err(error) = &outcome
                && !error.is_cancelled()
                && let Some(intake) = self.robots.get_mut(&robot)
            {
                intake.refuse(error);
            }
            self.note(&mut step, &robot, outcome)?;
            self.known.is_stale |=
                self.session.robot(&robot).is_some_and(|r| r.placement.is_some());
        }
        let is_known = |name: &str| self.session.robot(name).is_some();
        let (ready, waiting): (BTreeMap<String, RobotPrior>, _) =
            std::mem::take(&mut self.priors).into_iter().partition(|(name, _)| is_known(name));
        self.priors = waiting;
        for (robot, prior) in ready {
            let outcome = self.session.set_prior(&robot, prior, progress);
            self.note(&mut step, &robot, outcome)?;
        }
        self.publish(&mut step, now, progress)?;
        Ok(step)
    }

    fn obey(
        &mut self,
        command: &Command,
        progress: &dyn Progress,
    ) -> Result<Vec<Change>, MergeError> {
        match command {
            Command::Separate(robot) => self.session.separate(robot, progress),
            Command::Release(robot) => self.session.release(robot, progress),
            Command::Reconsider => self.session.reconsider(progress),
            Command::Remove(robot) => {
                self.robots.remove(robot);
                self.priors.remove(robot);
                if !self.session.remove(robot) {
                    return Err(MergeError::NoSuchRobot { name: robot.clone() });
                }
                self.known.is_stale = true;
                Ok(Vec::new())
            }
        }
    }

    /// The map of the robot that waits longest for its turn.
    fn next_map(&mut self, step: &mut Step) -> Option<(String, OccupancyGrid)> {
        let waiting = self.robots.iter_mut().filter(|(_, intake)| intake.is_waiting());
        let (robot, intake) = waiting.min_by_key(|(_, intake)| intake.turn)?;
        self.turn += 1;
        intake.turn = self.turn;
        let map = intake.take(self.params.limits.cells);
        if map.is_none() && !intake.trouble.is_empty() {
            step.news.push(format!("{robot}: refused: {}", intake.trouble));
        }
        Some((robot.clone(), map?))
    }

    /// Says what changed; only a cancelled call ends the step.
    fn note(
        &mut self,
        step: &mut Step,
        what: &str,
        outcome: Result<Vec<Change>, MergeError>,
    ) -> Result<(), LiveError> {
        match outcome {
            Ok(changes) => {
                self.known.is_stale |= !changes.is_empty();
                step.news.extend(changes.iter().map(told));
                Ok(())
            }
            Err(error) if error.is_cancelled() => Err(error.into()),
            Err(error) => {
                self.answer = format!("{what}: {error}");
                step.news.push(self.answer.clone());
                Ok(())
            }
        }
    }

    fn publish(
        &mut self,
        step: &mut Step,
        now: Time,
        progress: &dyn Progress,
    ) -> Result<(), LiveError> {
        let frames = self.frames();
        if frames != self.known.frames {
            let message = transforms(&frames, &self.params.world_frame, now);
            step.messages.push(written(Output::Transforms, &message)?);
            self.known.frames = frames;
        }
        let is_stale = std::mem::take(&mut self.known.is_stale);
        if is_stale && let Some(merged) = self.session.fuse(&self.params.fusion, progress)? {
            let header = Header { stamp: now, frame_id: self.params.world_frame.clone() };
            let conflicts = conflicts(&merged);
            for (output, map) in [(Output::Map, &merged.map), (Output::Conflicts, &conflicts)] {
                let message = OccupancyGridMessage::from_map(header.clone(), map)?;
                step.messages.push(written(output, &message)?);
            }
        }
        let last = self.known.status.map_or(0, Time::nanoseconds);
        if is_stale || now.nanoseconds().abs_diff(last) >= STATUS_EVERY_NS {
            self.known.status = Some(now);
            step.messages.push(written(Output::Status, &self.status(now))?);
        }
        Ok(())
    }

    fn frames(&self) -> Vec<PlacedFrame> {
        let placed = self.session.robots().into_iter().filter_map(|robot| {
            let said = self.robots.get(&robot.name).map_or("", |intake| &intake.frame);
            Some(PlacedFrame {
                name: map_frame(&robot.name, said),
                world_from_frame: robot.placement?.world_from_map,
            })
        });
        placed.collect()
    }

    fn status(&self, now: Time) -> DiagnosticArray {
        let states = self.session.robots();
        let placed = states.iter().filter(|state| state.placement.is_some()).count();
        let team = status::of_team(placed, self.robots.len(), self.turned_away, &self.answer);
        let robots = self.robots.iter().map(|(name, intake)| {
            let state = states.iter().find(|state| state.name == *name);
            status::of_robot(name, intake, state, self.params.session.align.matching.accept, now)
        });
        let header = Header { stamp: now, frame_id: self.params.world_frame.clone() };
        DiagnosticArray { header, status: std::iter::once(team).chain(robots).collect() }
    }
}

fn written<T: Serialize>(output: Output, message: &T) -> Result<Message, LiveError> {
    Ok(Message { output, bytes: to_cdr(message)? })
}

/// The conflicts of a merged map as a map: certain where there is one, free elsewhere.
fn conflicts(merged: &Merged) -> OccupancyGrid {
    let [free, conflict] = [0.0, 1.0].map(Occupancy::from_probability);
    let cells = merged.conflicts.to_grid();
    OccupancyGrid::new(*merged.map.frame(), cells.map(|&is| if is { conflict } else { free }))
}

fn told(change: &Change) -> String {
    let robot = &change.robot;
    match &change.kind {
        ChangeKind::Placed { world_from_map, probability } => {
            format!("{robot}: placed at {world_from_map} with probability {probability:.3}")
        }
        ChangeKind::Moved { old_world_from_map, world_from_map, probability } => format!(
            "{robot}: moved from {old_world_from_map} to {world_from_map}, probability \
             {probability:.3}"
        ),
        ChangeKind::Undone { old_world_from_map, because } => {
            format!("{robot}: no longer at {old_world_from_map}: {because:?}")
        }
        ChangeKind::NewFrame => format!("{robot}: its map started anew in another frame"),
        other => format!("{robot}: {other:?}"),
    }
}
