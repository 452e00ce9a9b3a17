//! The live merging without a network and without a clock: messages in, messages out.

mod command;
mod error;
mod intake;
mod names;
mod output;
mod params;
mod placed;
mod saved;
mod status;
mod step;

use std::collections::BTreeMap;

use ogm_core::Se2;
use ogm_io::ros::{MessageError, Time, from_cdr};
use ogm_merge::{MergeSession, RobotPrior};

use crate::message::{PoseWithCovarianceStamped, Text};

use self::intake::Intake;
use self::placed::Known;

pub use self::command::Command;
pub use self::error::LiveError;
pub use self::names::robot_of;
pub use self::output::{Message, Output};
pub use self::params::{Limits, LiveParams};
pub use self::saved::SavedLive;
pub use self::step::Step;

/// Maps of a running team that become one map.
///
/// What comes in is only put aside: of each robot the latest map waits, however fast it sends.
/// [`step`](Self::step) takes up one of them, whose turn it is, and says what is to be published;
/// so the merging goes at the pace of whoever steps, and no robot takes another's turn.
#[derive(Debug)]
pub struct Live {
    params: LiveParams,
    session: MergeSession,
    robots: BTreeMap<String, Intake>,
    /// Messages of robots that are too many.
    turned_away: u64,
    /// Poses that wait for their robot's first map.
    priors: BTreeMap<String, RobotPrior>,
    commands: Vec<Command>,
    /// What became of the last order.
    answer: String,
    turn: u64,
    known: Known,
}

impl Live {
    /// Nothing known yet.
    ///
    /// # Errors
    /// Parameters outside their range.
    pub fn new(params: LiveParams) -> Result<Self, LiveError> {
        Ok(Self {
            session: MergeSession::new(params.session.clone())?,
            priors: params.priors.clone(),
            params,
            robots: BTreeMap::new(),
            turned_away: 0,
            commands: Vec::new(),
            answer: String::new(),
            turn: 0,
            known: Known::default(),
        })
    }

    /// Takes the bytes of a `nav_msgs/msg/OccupancyGrid` of a robot.
    pub fn put_map(&mut self, robot: &str, message: Vec<u8>, now: Time) {
        if let Some(intake) = self.intake(robot) {
            intake.put_map(message, now);
        }
    }

    /// Takes the bytes of a `map_msgs/msg/OccupancyGridUpdate` of a robot.
    pub fn put_update(&mut self, robot: &str, message: Vec<u8>, now: Time) {
        if let Some(intake) = self.intake(robot) {
            intake.put_update(message, now);
        }
    }

    /// Takes the bytes of a `geometry_msgs/msg/PoseWithCovarianceStamped`: where the map frame of a
    /// robot lies in the world. A covariance of zeros pins it there.
    ///
    /// # Errors
    /// Bytes that are no such message, or no pose on the floor.
    pub fn put_prior(&mut self, robot: &str, message: &[u8]) -> Result<(), MessageError> {
        let message: PoseWithCovarianceStamped = from_cdr(message)?;
        let world_from_map: Se2 = message.pose.flat()?;
        let variance = |at: usize| message.covariance[at].max(0.0);
        let sigma_m = variance(0).max(variance(7)).sqrt();
        let prior = RobotPrior { world_from_map, sigma_m, sigma_rad: variance(35).sqrt() };
        if self.intake(robot).is_some() {
            self.priors.insert(robot.to_owned(), prior);
        }
        Ok(())
    }

    /// Takes the bytes of a `std_msgs/msg/String`: an order, see [`Command`].
    ///
    /// # Errors
    /// Bytes that are no such message; a line that is no order is answered in the status.
    pub fn put_command(&mut self, message: &[u8]) -> Result<(), MessageError> {
        match from_cdr::<Text>(message)?.data.parse() {
            // One a step: whoever sends more has the last word.
            Ok(command) => self.commands = vec![command],
            Err(why) => (self.answer, self.known.status) = (why, None),
        }
        Ok(())
    }

    /// Whether something waits for a step.
    #[must_use]
    pub fn is_waiting(&self) -> bool {
        !self.commands.is_empty() || self.robots.values().any(Intake::is_waiting)
    }

    /// `None` for one robot too many.
    fn intake(&mut self, robot: &str) -> Option<&mut Intake> {
        if !self.robots.contains_key(robot) && self.robots.len() >= self.params.limits.robots {
            self.turned_away += 1;
            return None;
        }
        Some(self.robots.entry(robot.to_owned()).or_default())
    }
}
